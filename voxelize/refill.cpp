#include "voxelize/refill.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/error.hpp"
#include "voxelize/index_lookup.hpp"
#include "voxelize/lattice/corner_nodes.hpp"
#include "voxelize/random/random.hpp"

namespace springlod::voxelize {
namespace {

// Tried cell edges, as multiples of the edge of the cube that a node represents. `corners` has more
// nodes than cells, so its cells are larger. Steps of 1 % find every possible count of a small
// body.
constexpr double kSmallestTried = 0.6;
constexpr double kStep = 1.01;
constexpr int kTries = 144;  // up to 2.5

struct GridSums {
  double volume = 0;
  double mass = 0;
  Vec3 center = Vec3::Zero();  // of mass
  Box3 box;
};

GridSums sums_of(const MaterialGrid& grid) {
  GridSums sums;
  const double cell_volume = std::pow(grid.cell, 3);
  for (std::size_t n = 0; n < grid.cells.size(); ++n) {
    const CellIndex& c = grid.cells[n];
    const Vec3 low = grid.origin + grid.cell * Vec3(c[0], c[1], c[2]);
    const double mass = cell_volume * grid.materials[grid.material[n]].density;
    sums.volume += cell_volume;
    sums.mass += mass;
    sums.center += mass * (low + Vec3::Constant(grid.cell / 2));
    sums.box.extend(low);
    sums.box.extend(low + Vec3::Constant(grid.cell));
  }
  sums.center /= sums.mass;
  return sums;
}

/// The body in cells of edge `cell`, each with the material at its centre.
MaterialGrid resampled(const MaterialGrid& grid, const IndexLookup& lookup, const Box3& box,
                       double cell) {
  MaterialGrid coarse;
  coarse.cell = cell;
  coarse.materials = grid.materials;
  CellIndex size{};
  for (int d = 0; d < 3; ++d)
    size[d] = std::max(1, static_cast<std::int32_t>(std::lround(box.sizes()[d] / cell)));
  coarse.origin = box.center() - cell / 2 * Vec3(size[0], size[1], size[2]);
  for (std::int32_t z = 0; z < size[2]; ++z)
    for (std::int32_t y = 0; y < size[1]; ++y)
      for (std::int32_t x = 0; x < size[0]; ++x) {
        const Vec3 at =
            (coarse.origin + cell * Vec3(x + 0.5, y + 0.5, z + 0.5) - grid.origin) / grid.cell;
        const std::uint32_t fine = lookup.find({static_cast<std::int32_t>(std::floor(at.x())),
                                                static_cast<std::int32_t>(std::floor(at.y())),
                                                static_cast<std::int32_t>(std::floor(at.z()))});
        if (fine == kNoIndex) continue;
        coarse.cells.push_back({x, y, z});
        coarse.material.push_back(grid.material[fine]);
      }
  return coarse;
}

std::size_t node_count(const MaterialGrid& grid, LatticeStyle style) {
  return style == LatticeStyle::centers ? grid.cells.size() : corner_nodes(grid.cells).at.size();
}

/// Scales a model to the volume, mass and centre of mass of the grid. A body of one material
/// changes its size slightly; k and c scale with its lengths, so that E by eq. 2 is kept.
void fit(MassSpringModel& model, const GridSums& target) {
  const MassProperties now = mass_properties(model);
  const double length = std::cbrt(target.volume / now.volume);
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    model.rest[i] = target.center + length * (model.rest[i] - now.center);
    model.mass[i] *= target.mass / now.mass;
    model.volume[i] *= target.volume / now.volume;
    model.contact_area[i] *= length * length;
  }
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    model.rest_length[s] = (model.rest[model.b[s]] - model.rest[model.a[s]]).norm();
    model.stiffness[s] *= length;
    model.damping[s] *= length;
  }
  for (double& modulus : model.dilatation.modulus) modulus *= target.volume / now.volume;
  for (Vec3& gradient : model.dilatation.gradient) gradient /= length;
}

Level refilled_level(const MaterialGrid& grid, std::uint32_t nodes, const RefillOptions& options) {
  Level level;
  if (options.style == RefillStyle::random) {
    level.model = build_random(grid, {.nodes = nodes,
                                      .ends = options.ends,
                                      .seed = options.seed,
                                      .volumes = options.volumes,
                                      .progress = options.progress})
                      .model;
    level.made_by =
        fmt::format("refill random, {} nodes, {} ends, seed {}", nodes, options.ends, options.seed);
  } else {
    level.model = lattice_of_about(grid, nodes, options.lattice, options.volumes);
    level.made_by = fmt::format("refill {}, {} nodes of {} wanted", to_string(options.lattice),
                                level.model.node_count(), nodes);
  }
  return level;
}

}  // namespace

MassSpringModel lattice_of_about(const MaterialGrid& grid, std::uint32_t nodes, LatticeStyle style,
                                 bool volumes) {
  if (!grid.fraction.empty()) return lattice_of_about(whole_cells(grid), nodes, style, volumes);
  validate(grid);
  if (grid.cells.empty() || nodes == 0)
    throw InputError("refill: the grid must have filled cells, and a level at least one node");
  const GridSums target = sums_of(grid);
  const IndexLookup lookup(grid.cells);
  const double even = std::cbrt(target.volume / nodes);
  MaterialGrid best;
  std::size_t least_error = std::numeric_limits<std::size_t>::max();
  for (int i = 0; i < kTries; ++i) {
    const double cell = kSmallestTried * even * std::pow(kStep, i);
    MaterialGrid tried = resampled(grid, lookup, target.box, cell);
    if (tried.cells.empty()) continue;
    const std::size_t count = node_count(tried, style);
    const std::size_t error = count > nodes ? count - nodes : nodes - count;
    if (error >= least_error) continue;
    least_error = error;
    best = std::move(tried);
  }
  if (best.cells.empty())
    throw InputError(fmt::format(
        "refill: a lattice of about {} nodes has no cell in the body; use more nodes", nodes));
  MassSpringModel model =
      build_lattice(best, {.style = style, .hinges = HingePolicy::fill, .volumes = volumes}).model;
  fit(model, target);
  return model;
}

std::vector<Level> refill_levels(const MaterialGrid& grid, const RefillOptions& options) {
  if (!grid.fraction.empty()) return refill_levels(whole_cells(grid), options);
  if (options.nodes.empty())
    throw InputError(
        "refill: nodes is missing; give the number for each level, as in nodes = {161, 78}");
  Task task(options.progress, "refilling", options.nodes.size());
  std::vector<Level> levels;
  for (const std::uint32_t nodes : options.nodes) {
    levels.push_back(refilled_level(grid, nodes, options));
    task.advance();
  }
  return levels;
}

}  // namespace springlod::voxelize
