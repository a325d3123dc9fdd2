#include "voxelize/random/random.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include <fmt/format.h>

#include "base/error.hpp"
#include "elastic/moduli.hpp"
#include "model/node_dilatation.hpp"
#include "model/point_bins.hpp"
#include "voxelize/random/random_corners.hpp"
#include "voxelize/random/random_nodes.hpp"
#include "voxelize/random/random_springs.hpp"
#include "voxelize/random/random_stiffness.hpp"

namespace springlod::voxelize {
namespace {

/// Samples for each node: the error of Lloyd's centroids is then below a tenth of the spacing.
constexpr double kSamplesPerNode = 48;
/// Limit of the mean number of springs at a node: more reach through the whole of most bodies.
constexpr double kMostEnds = 1000;
std::uint32_t node_count(const MaterialGrid& grid, const RandomOptions& options) {
  if (!(options.ends >= kLeastRandomEnds) || !(options.ends < kMostEnds))
    throw InputError(fmt::format(
        "random: ends = {} must be {} or more, so that no node is floppy, and below {} (18 is "
        "usual)",
        options.ends, kLeastRandomEnds, kMostEnds));
  double nodes = options.nodes.value_or(0);
  if (!options.nodes) {
    const double spacing = options.spacing.value_or(grid.cell);
    if (!(spacing > 0))
      throw InputError(fmt::format("random: spacing = {} m must be above 0", spacing));
    nodes = std::round(static_cast<double>(grid.cells.size()) * std::pow(grid.cell / spacing, 3));
  }
  if (nodes <= kLeastRandomEnds || nodes > kMostRandomNodes)
    throw InputError(
        fmt::format("random: nodes = {}; use at least {} for {} ends each, and at most {}", nodes,
                    kLeastRandomEnds + 1, kLeastRandomEnds, kMostRandomNodes));
  return static_cast<std::uint32_t>(nodes);
}

void sort_nodes(RandomNodes& nodes, std::vector<bool>& on_surface) {
  std::vector<std::uint32_t> order(nodes.at.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    const Vec3& p = nodes.at[i];
    const Vec3& q = nodes.at[j];
    return std::tuple(p.z(), p.y(), p.x(), i) < std::tuple(q.z(), q.y(), q.x(), j);
  });
  RandomNodes sorted = nodes;
  on_surface.assign(order.size(), false);
  for (std::size_t n = 0; n < order.size(); ++n) {
    sorted.at[n] = nodes.at[order[n]];
    sorted.cell[n] = nodes.cell[order[n]];
    on_surface[n] = order[n] < nodes.outer;
  }
  nodes = std::move(sorted);
}

/// Assigns each sample of the volume to the nearest node.
void share_volume(const MaterialGrid& grid, const GridSamples& samples, double spacing,
                  MassSpringModel& model) {
  const std::size_t kinds = grid.materials.size();
  const PointBins bins(model.rest, samples.box, spacing);
  std::vector<std::uint32_t> pieces(model.rest.size() * kinds, 0);
  for (std::size_t i = 0; i < samples.inner.size(); ++i)
    ++pieces[bins.nearest(samples.inner[i]).point * kinds + grid.material[samples.inner_cell[i]]];
  for (std::size_t n = 0; n < model.rest.size(); ++n) {
    const auto first = pieces.begin() + static_cast<std::ptrdiff_t>(n * kinds);
    double mass = 0;
    double volume = 0;
    for (std::size_t m = 0; m < kinds; ++m) {
      const double part = first[static_cast<std::ptrdiff_t>(m)] * samples.inner_volume;
      volume += part;
      mass += part * grid.materials[m].density;
    }
    if (volume == 0)
      throw InputError(
          fmt::format("random: no volume is left for the node at ({:.4g}, {:.4g}, {:.4g}) m; "
                      "use fewer nodes",
                      model.rest[n].x(), model.rest[n].y(), model.rest[n].z()));
    model.volume.push_back(volume);
    model.mass.push_back(mass);
    const auto most = std::max_element(first, first + static_cast<std::ptrdiff_t>(kinds));
    model.material.push_back(static_cast<std::uint32_t>(most - first));
  }
}

/// Assigns each sample of the surface to the nearest surface node. Returns for each node the sum of
/// outward normal times area [m2].
std::vector<Vec3> share_surface(const GridSamples& samples, double spacing,
                                const std::vector<bool>& on_surface, MassSpringModel& model) {
  std::vector<Vec3> outer;
  std::vector<std::uint32_t> node;
  for (std::uint32_t n = 0; n < model.node_count(); ++n)
    if (on_surface[n]) {
      outer.push_back(model.rest[n]);
      node.push_back(n);
    }
  const PointBins bins(outer, samples.box, spacing);
  std::vector<std::uint32_t> pieces(model.rest.size(), 0);
  std::vector<Vec3> surface(model.rest.size(), Vec3::Zero());
  for (std::size_t i = 0; i < samples.outer.size(); ++i) {
    const std::uint32_t n = node[bins.nearest(samples.outer[i]).point];
    ++pieces[n];
    surface[n] += samples.outer_area * samples.outward[i];
  }
  for (const std::uint32_t count : pieces) model.contact_area.push_back(count * samples.outer_area);
  return surface;
}

struct Measured {
  double young = 0;  // as a fraction of the target
  double poisson = 0;

  double shear() const { return young / (2 * (1 + poisson)); }
  double bulk() const { return young / (3 * (1 - 2 * poisson)); }
};

bool is_box(const MaterialGrid& grid) {
  Eigen::Vector3i low = Eigen::Vector3i::Constant(std::numeric_limits<int>::max());
  Eigen::Vector3i high = Eigen::Vector3i::Constant(std::numeric_limits<int>::min());
  for (const CellIndex& c : grid.cells) {
    low = low.cwiseMin(Eigen::Vector3i(c[0], c[1], c[2]));
    high = high.cwiseMax(Eigen::Vector3i(c[0], c[1], c[2]));
  }
  const Eigen::Vector3d size = (high - low).cast<double>() + Vec3::Ones();
  return size.prod() == static_cast<double>(grid.cells.size());
}

/// A box is measured by stretch tests along its edges, any other shape by surface tractions.
Measured measure(const MaterialGrid& grid, const MassSpringModel& model,
                 const std::vector<Vec3>& surface) {
  if (!is_box(grid)) {
    const elastic::SurfaceStretchResult result = elastic::surface_stretch(model, surface);
    return {result.young, result.poisson};
  }
  Measured mean;
  for (int axis = 0; axis < 3; ++axis) {
    const elastic::StretchResult result = elastic::stretch_test(model, {.axis = axis});
    mean.young += result.young / 3;
    mean.poisson += result.poisson / 3;
  }
  return mean;
}

/// What the springs of a material, or between two materials, are made of.
struct SpringMaterial {
  double young = 0;
  double damping = 0;
};

/// Two half springs in series, as in a `centers` lattice (docs/method.md, eq. 8).
SpringMaterial series(const SpringMaterial& m1, const SpringMaterial& m2) {
  if (m1.young == m2.young && m1.damping == m2.damping) return m1;
  const double sum = m1.young + m2.young;
  return {2 * m1.young * m2.young / sum, (m1.damping * m2.young + m2.damping * m1.young) / sum};
}

/// Springs for E = 1 Pa without damping, for the stretch test.
void add_unit_springs(const std::vector<NodePair>& pairs, MassSpringModel& model) {
  model.stiffness = unit_stiffness(pairs, model.volume);
  model.damping.assign(pairs.size(), 0);
  for (const NodePair& pair : pairs) {
    model.a.push_back(pair.a);
    model.b.push_back(pair.b);
    model.rest_length.push_back((model.rest[pair.b] - model.rest[pair.a]).norm());
  }
}

/// Factors with which the network has the moduli of a material, and the moduli measured with them.
struct Rescaling {
  double springs = 1;
  double terms = 1;
  double eq2_young = 0;  // measured without the factors
  Measured measured;
};

Measured measure_with(const MaterialGrid& grid, const MassSpringModel& unit,
                      const std::vector<Vec3>& surface, const Material& material,
                      const Rescaling& factors) {
  MassSpringModel model = unit;
  for (double& k : model.stiffness) k *= factors.springs * spring_young(material);
  model.materials = {material};
  model.material.assign(model.rest.size(), 0);
  model.dilatation = material_terms(model, {factors.terms});
  return measure(grid, model, surface);
}

/// Nodes do not move affinely, by which springs lose more than terms do: both factors follow from
/// the shear and the bulk modulus measured with the last ones.
void fit_factors(const MaterialGrid& grid, const MassSpringModel& unit,
                 const std::vector<Vec3>& surface, const Material& material, Rescaling& factors) {
  constexpr int kMostTests = 12;
  constexpr double kCloseYoung = 2e-3, kClosePoisson = 1e-3;
  constexpr double kMostChange = 2;  // of the factor of the terms in one test
  const Measured wanted{1, material.poisson};
  const double modulus = dilatation_modulus(material);
  for (int test = 0; test < kMostTests; ++test) {
    Measured& found = factors.measured;
    if (std::abs(found.young - 1) < kCloseYoung &&
        std::abs(found.poisson - material.poisson) < kClosePoisson)
      return;
    // A test may show more than 1/2, where the bulk modulus has no meaning.
    constexpr double kMostPoisson = 0.4995;
    const Measured sound{found.young, std::min(found.poisson, kMostPoisson)};
    const double shear = wanted.shear() / sound.shear();
    const double missing = wanted.bulk() - shear * sound.bulk();
    const double change = (shear * factors.terms * modulus + missing) / (factors.terms * modulus);
    factors.springs *= shear;
    factors.terms *= std::clamp(change, 1 / kMostChange, kMostChange);
    found = measure_with(grid, unit, surface, material, factors);
  }
}

/// One test serves all materials with the ratio of springs.
std::vector<Rescaling> rescalings(const MaterialGrid& grid, const MassSpringModel& unit,
                                  const std::vector<Vec3>& surface, bool rescale) {
  std::vector<Rescaling> all;
  for (std::size_t m = 0; m < grid.materials.size(); ++m) {
    Material material = grid.materials[m];
    const auto same = std::find_if(
        grid.materials.begin(), grid.materials.begin() + static_cast<std::ptrdiff_t>(m),
        [&](const Material& other) { return other.poisson == material.poisson; });
    const auto before = static_cast<std::size_t>(same - grid.materials.begin());
    if (before < m) {
      all.push_back(all[before]);
      continue;
    }
    material.young = 1;
    Rescaling& factors = all.emplace_back();
    factors.measured = measure_with(grid, unit, surface, material, factors);
    factors.eq2_young = factors.measured.young;
    if (!rescale) continue;
    if (material.poisson == kSpringPoisson) {
      factors.springs = 1 / factors.measured.young;
      factors.measured.young *= factors.springs;
    } else {
      fit_factors(grid, unit, surface, material, factors);
    }
  }
  return all;
}

std::vector<std::uint32_t> nodes_of_materials(const MassSpringModel& model) {
  std::vector<std::uint32_t> count(model.materials.size(), 0);
  for (const std::uint32_t m : model.material) ++count[m];
  return count;
}

void apply_materials(const std::vector<Rescaling>& factors, MassSpringModel& model) {
  const auto springs_of = [&](std::uint32_t node) {
    const Material& material = model.materials[model.material[node]];
    return SpringMaterial{spring_young(material), material.damping};
  };
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    SpringMaterial a = springs_of(model.a[s]);
    SpringMaterial b = springs_of(model.b[s]);
    double factor = factors[model.material[model.a[s]]].springs;
    const double other = factors[model.material[model.b[s]]].springs;
    if (factor != other) {
      a.young *= factor;
      b.young *= other;
      factor = 1;
    }
    const SpringMaterial pair = series(a, b);
    model.stiffness[s] *= factor * pair.young;
    model.damping[s] = pair.damping * model.stiffness[s];
  }
  std::vector<double> of_terms;
  for (const Rescaling& each : factors) of_terms.push_back(each.terms);
  model.dilatation = material_terms(model, of_terms);
}

void count_ends(RandomModel& random) {
  std::vector<std::uint32_t> ends(random.model.rest.size(), 0);
  for (const auto* side : {&random.model.a, &random.model.b})
    for (const std::uint32_t n : *side) ++ends[n];
  random.least_ends = *std::min_element(ends.begin(), ends.end());
  random.mean_ends = static_cast<double>(random.model.end_count()) / random.model.node_count();
}

}  // namespace

RandomModel build_random(const MaterialGrid& grid, const RandomOptions& options) {
  if (!grid.fraction.empty()) return build_random(whole_cells(grid), options);
  validate(grid);
  if (grid.cells.empty())
    throw InputError("random: the grid has no filled cells; use smaller cells");
  const std::uint32_t count = node_count(grid, options);
  const GridSamples samples = sample_grid(grid, count, kSamplesPerNode);
  RandomNodes nodes = place_nodes(grid, samples, count, options.seed, options.progress);
  std::vector<bool> on_surface;
  sort_nodes(nodes, on_surface);

  RandomModel random;
  MassSpringModel& model = random.model;
  model.rest = nodes.at;
  model.materials = grid.materials;
  model.border.assign(on_surface.begin(), on_surface.end());
  share_volume(grid, samples, nodes.spacing, model);
  const std::vector<Vec3> surface = share_surface(samples, nodes.spacing, on_surface, model);
  add_unit_springs(choose_pairs(grid, nodes, samples.box, options.ends, kLeastRandomEnds), model);
  validate(model);
  random.components = connected_components(model).count;
  count_ends(random);

  const std::vector<Rescaling> factors = rescalings(grid, model, surface, options.rescale);
  const std::vector<std::uint32_t> nodes_of = nodes_of_materials(model);
  const Rescaling& main = factors[static_cast<std::size_t>(
      std::max_element(nodes_of.begin(), nodes_of.end()) - nodes_of.begin())];
  random.eq2_young = main.eq2_young;
  random.young = main.measured.young;
  random.poisson = main.measured.poisson;
  random.rescaled = main.springs;
  apply_materials(factors, model);
  if (options.volumes) model.corners = choose_corners(model);
  return random;
}

}  // namespace springlod::voxelize
