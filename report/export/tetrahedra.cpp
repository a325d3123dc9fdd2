#include "report/export/tetrahedra.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

namespace springlod::report {
namespace {

constexpr unsigned kCorners = 8;
constexpr double kSame = 1e-6;  // relative: positions and moduli that are equal but for rounding

bool same(double a, double b) {
  return std::abs(a - b) <= kSame * std::max(std::abs(a), std::abs(b));
}

struct CubeCell {
  std::array<std::uint32_t, kCorners> node{};  // by octant; bit 0: the high side along x
  double young = 0;                            // of the material times the filled fraction [Pa]
};

// The corner with its place: the centre of its cell in units of the edge.
struct PlacedCorner {
  std::array<std::int64_t, 3> cell{};
  unsigned octant = 0;
  std::uint32_t number = 0;
};

// Length of the edges of a corner if they lie along the three axes and are equal.
std::optional<double> cube_edge(const Corner& corner, const std::vector<Vec3>& x) {
  const double edge = (x[corner.node[1]] - x[corner.node[0]]).norm();
  for (unsigned i = 1; i < 4; ++i) {
    const Vec3 along = (x[corner.node[i]] - x[corner.node[0]]).cwiseAbs();
    if (std::abs(along.maxCoeff() - edge) > kSame * edge ||
        std::abs(along.sum() - edge) > kSame * edge)
      return std::nullopt;
  }
  return edge;
}

Vec3 half_diagonal(const Corner& corner, const std::vector<Vec3>& x) {
  Vec3 sum = Vec3::Zero();
  for (unsigned i = 1; i < 4; ++i) sum += x[corner.node[i]] - x[corner.node[0]];
  return sum / 2;
}

// All corners by their cell and octant; empty if one is no corner of a cube of that edge.
std::vector<PlacedCorner> placed_corners(const MassSpringModel& model, double edge) {
  std::vector<PlacedCorner> placed;
  placed.reserve(model.corners.size());
  const Vec3 origin = model.rest[model.corners.front().node[0]];
  for (std::uint32_t c = 0; c < model.corner_count(); ++c) {
    const Corner& corner = model.corners[c];
    const auto length = cube_edge(corner, model.rest);
    if (!length || !same(*length, edge)) return {};
    const Vec3 inward = half_diagonal(corner, model.rest);
    const Vec3 centre = (model.rest[corner.node[0]] + inward - origin) / edge;
    PlacedCorner& at = placed.emplace_back();
    at.number = c;
    for (unsigned axis = 0; axis < 3; ++axis) {
      at.cell[axis] = std::lround(centre[axis] - 0.5);
      if (inward[axis] < 0) at.octant |= 1U << axis;
    }
  }
  std::sort(placed.begin(), placed.end(), [](const PlacedCorner& l, const PlacedCorner& r) {
    return std::tie(l.cell, l.octant) < std::tie(r.cell, r.octant);
  });
  return placed;
}

// Groups of eight corners, one for each octant of a cell. Empty if a cell lacks one.
std::vector<CubeCell> cube_cells(const MassSpringModel& model) {
  if (model.corners.empty() || model.corners.size() % kCorners != 0) return {};
  const auto edge = cube_edge(model.corners.front(), model.rest);
  if (!edge) return {};
  const std::vector<PlacedCorner> placed = placed_corners(model, *edge);
  std::vector<CubeCell> cells;
  for (std::size_t first = 0; first < placed.size(); first += kCorners) {
    CubeCell cell{.node = {}, .young = model.corners[placed[first].number].young};
    for (unsigned octant = 0; octant < kCorners; ++octant) {
      const PlacedCorner& at = placed[first + octant];
      const Corner& corner = model.corners[at.number];
      if (at.cell != placed[first].cell || at.octant != octant || !same(corner.young, cell.young))
        return {};
      cell.node[octant] = corner.node[0];
    }
    cells.push_back(cell);
  }
  return cells;
}

// Moduli of the dilatation terms [J] by their nodes.
using TermModuli = std::map<std::array<std::uint32_t, kCorners>, double>;

TermModuli term_moduli(const DilatationTerms& terms) {
  TermModuli moduli;
  for (std::uint32_t t = 0; t < terms.count(); ++t) {
    const auto nodes = terms.nodes(t);
    if (nodes.size() != kCorners) continue;
    std::array<std::uint32_t, kCorners> key{};
    std::copy(nodes.begin(), nodes.end(), key.begin());
    moduli[key] = terms.modulus[t];
  }
  return moduli;
}

// The material of a cell, which its model does not state: one that explains the modulus of its
// corners and its dilatation term. Of several, the one that most of its nodes have; a node whose
// cells have all the same density decides, for the material of the others is that of the most of
// their cells.
class CellMaterials {
 public:
  CellMaterials(const MassSpringModel& model, double volume)
      : model_(model), terms_(term_moduli(model.dilatation)), volume_(volume) {}

  std::uint32_t of(const CubeCell& cell) const {
    std::vector<double> votes(model_.materials.size(), 0);
    for (const std::uint32_t node : cell.node) {
      const std::uint32_t m = model_.material[node];
      const bool pure = same(model_.mass[node], model_.materials[m].density * model_.volume[node]);
      votes[m] += pure ? kPure : 1;
    }
    for (std::uint32_t m = 0; m < votes.size(); ++m) votes[m] += kExplained * explains(m, cell);
    return static_cast<std::uint32_t>(std::max_element(votes.begin(), votes.end()) - votes.begin());
  }

 private:
  static constexpr double kPure = kCorners + 1;                     // outvotes all mixed nodes
  static constexpr double kExplained = kCorners * (kCorners + 1.);  // outvotes all nodes

  // 2: as a whole cell; 1: as one that is cut; 0: not.
  int explains(std::uint32_t m, const CubeCell& cell) const {
    const Material& material = model_.materials[m];
    const double fraction = cell.young / material.young;
    if (fraction > 1 + kSame) return 0;
    auto key = cell.node;
    std::sort(key.begin(), key.end());
    const auto term = terms_.find(key);
    const double modulus = term == terms_.end() ? 0 : term->second;
    if (!same(modulus, fraction * dilatation_modulus(material) * volume_)) return 0;
    return fraction >= 1 - kSame ? 2 : 1;
  }

  const MassSpringModel& model_;
  TermModuli terms_;
  double volume_;  // of a cell [m3]
};

// Six paths from octant 0 to octant 7 along the edges, one for each order of the axes. Neighbours
// split their common face along the same diagonal, for all cells split alike.
constexpr std::array<std::array<unsigned, 4>, 6> kPaths{
    {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 3, 2, 7}, {0, 6, 4, 7}, {0, 5, 1, 7}}};

std::vector<double> of_materials(const MassSpringModel& model, const Tetrahedra& of,
                                 double Material::*value, bool by_fraction) {
  std::vector<double> values;
  values.reserve(of.nodes.size());
  for (std::uint32_t t = 0; t < of.count(); ++t)
    values.push_back(model.materials[of.material[t]].*value * (by_fraction ? of.fraction[t] : 1));
  return values;
}

}  // namespace

Tetrahedra tetrahedra_of_cells(const MassSpringModel& model) {
  const std::vector<CubeCell> cells = cube_cells(model);
  if (cells.empty()) return {};
  Tetrahedra all;
  all.cell = (model.rest[cells.front().node[1]] - model.rest[cells.front().node[0]]).norm();
  const double volume = all.cell * all.cell * all.cell;
  const CellMaterials materials(model, volume);
  double filled = 0;
  for (const CubeCell& cell : cells) {
    const std::uint32_t material = materials.of(cell);
    const double share = std::min(1.0, cell.young / model.materials[material].young);
    const double fraction = share > 1 - kSame ? 1 : share;
    filled += fraction * volume;
    for (const auto& path : kPaths) {
      auto& nodes = all.nodes.emplace_back();
      for (unsigned i = 0; i < 4; ++i) nodes[i] = cell.node[path[i]];
      all.material.push_back(material);
      all.fraction.push_back(fraction);
    }
  }
  // The nodes of a `centers` lattice are in the middle of cells, so cubes of nodes hold less.
  const double of_nodes = std::accumulate(model.volume.begin(), model.volume.end(), 0.0);
  return same(filled, of_nodes) ? all : Tetrahedra{};
}

std::string no_tetrahedra(const MassSpringModel& model) {
  if (model.corners.empty())
    return "tetrahedra: the level has no corners; build the base as a lattice of style corners "
           "with volumes";
  return "tetrahedra: only the base of a corners lattice has cells (level 0)";
}

std::vector<double> young_of(const MassSpringModel& model, const Tetrahedra& of) {
  return of_materials(model, of, &Material::young, true);
}

std::vector<double> poisson_of(const MassSpringModel& model, const Tetrahedra& of) {
  return of_materials(model, of, &Material::poisson, false);
}

std::vector<double> density_of(const MassSpringModel& model, const Tetrahedra& of) {
  return of_materials(model, of, &Material::density, true);
}

}  // namespace springlod::report
