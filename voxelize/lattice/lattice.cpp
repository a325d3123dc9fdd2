#include "voxelize/lattice/lattice.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "model/node_dilatation.hpp"
#include "voxelize/cell_material.hpp"
#include "voxelize/enough_memory.hpp"
#include "voxelize/index_lookup.hpp"
#include "voxelize/lattice/bind_surface.hpp"
#include "voxelize/lattice/cell_dilatation.hpp"
#include "voxelize/lattice/cell_stiffness.hpp"
#include "voxelize/lattice/corner_nodes.hpp"
#include "voxelize/lattice/corner_young.hpp"
#include "voxelize/lattice/hinges.hpp"

namespace springlod::voxelize {
namespace {

Vec3 corner_position(const MaterialGrid& grid, const CellIndex& at) {
  return grid.origin + grid.cell * Vec3(at[0], at[1], at[2]);
}

void add_node(MassSpringModel& model, const Vec3& rest, double mass, double volume, double area,
              bool border, std::uint32_t material) {
  model.rest.push_back(rest);
  model.mass.push_back(mass);
  model.volume.push_back(volume);
  model.contact_area.push_back(area);
  model.border.push_back(border ? 1 : 0);
  model.material.push_back(material);
}

// Adds the corner of `node` in an octant. `neighbours` are its neighbours along x, y and z, each on
// the octant's side.
void add_corner(MassSpringModel& model, std::uint32_t node, unsigned octant,
                std::array<std::uint32_t, 3> neighbours, double young) {
  // An odd number of negative sides makes the three directions left-handed.
  if (std::popcount(octant) % 2 == 0) std::swap(neighbours[1], neighbours[2]);
  std::rotate(neighbours.begin(), std::min_element(neighbours.begin(), neighbours.end()),
              neighbours.end());
  model.corners.push_back({{node, neighbours[0], neighbours[1], neighbours[2]}, young});
}

// Sorts the corners of the node that was added last, from `first` on.
void sort_corners(MassSpringModel& model, std::size_t first) {
  std::sort(model.corners.begin() + static_cast<std::ptrdiff_t>(first), model.corners.end(),
            [](const Corner& l, const Corner& r) { return l.node < r.node; });
}

void add_spring(MassSpringModel& model, std::uint32_t a, std::uint32_t b, double k, double c) {
  model.a.push_back(a);
  model.b.push_back(b);
  model.rest_length.push_back((model.rest[b] - model.rest[a]).norm());
  model.stiffness.push_back(k);
  model.damping.push_back(c);
}

// ---------------------------------------------------------------- corners

// Fractions of a cell on its low and its high face along each axis, x, y, z [1]. A face diagonal
// has that of its face, an edge the product of those of its two faces, a corner of those of its
// three.
using FaceShares = std::array<std::array<double, 2>, 3>;

FaceShares face_shares(const MaterialGrid& grid, const CornerNodes& nodes, std::uint32_t cell,
                       Bending bending) {
  constexpr double kHalf = 0.5;
  constexpr double kEndCorrection = 1. / 12;  // of Euler and Maclaurin's sum, with a difference
  const bool whole = grid.fraction_of(cell) == 1;  // the faces of a cut cell are not the body's
  FaceShares shares;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const auto is_free = [&](unsigned side) {
      const unsigned corner = side << axis;
      return nodes.around[nodes.of_cell[cell][corner]][(7 - corner) ^ (1U << axis)] == kNoIndex;
    };
    double moved = 0;  // from the low to the high face
    if (bending == Bending::corrected && whole)
      moved = kEndCorrection * (static_cast<double>(is_free(0)) - static_cast<double>(is_free(1)));
    shares[axis] = {kHalf - moved, kHalf + moved};
  }
  return shares;
}

void add_corner_node(MassSpringModel& model, const MaterialGrid& grid, const CornerNodes& nodes,
                     std::uint32_t node, Bending bending) {
  const double whole = grid.cell * grid.cell * grid.cell;
  const double quarter_face = grid.cell * grid.cell / 4;
  const auto& around = nodes.around[node];
  double mass = 0;
  double volume = 0;
  double area = 0;
  bool border = false;
  for (unsigned o = 0; o < 8; ++o) {
    if (around[o] == kNoIndex) {
      border = true;
      continue;
    }
    const FaceShares shares = face_shares(grid, nodes, around[o], bending);
    const double fraction = grid.fraction_of(around[o]);
    border |= fraction < 1;
    double part = whole * fraction;
    for (unsigned axis = 0; axis < 3; ++axis) part *= shares[axis][(7 - o) >> axis & 1U];
    mass += grid.materials[grid.material[around[o]]].density * part;
    volume += part;
    for (const unsigned across : {1U, 2U, 4U})
      if (around[o ^ across] == kNoIndex) area += quarter_face;
  }
  add_node(model, corner_position(grid, nodes.at[node]), mass, volume, area, border,
           commonest_material(grid,
                              around));  // cells have equal volumes, so the number of cells decides
}

struct SpringSum {
  std::uint32_t to = 0;
  double k = 0;
  double c = 0;
};

// Springs of `node` to higher nodes, summed over the cells around it, by ascending `to`.
void gather_springs(const MaterialGrid& grid, const CornerNodes& nodes, std::uint32_t node,
                    Bending bending, std::vector<SpringSum>& sums) {
  sums.clear();
  for (unsigned o = 0; o < 8; ++o) {
    const std::uint32_t cell = nodes.around[node][o];
    if (cell == kNoIndex) continue;
    const Material& material = grid.materials[grid.material[cell]];
    const double cell_k = grid.fraction_of(cell) * cell_stiffness(material, grid.cell);
    const FaceShares shares = face_shares(grid, nodes, cell, bending);
    const unsigned here = 7 - o;
    const auto share_of = [&](unsigned axis) { return shares[axis][here >> axis & 1U]; };
    const auto add = [&](unsigned step, double share) {
      const std::uint32_t to = nodes.of_cell[cell][here ^ step];
      if (to < node) return;
      auto at = std::find_if(sums.begin(), sums.end(),
                             [&](const SpringSum& sum) { return sum.to == to; });
      if (at == sums.end()) at = sums.insert(at, {to, 0, 0});
      at->k += share * cell_k;
      at->c += share * material.damping * cell_k;
    };
    for (unsigned axis = 0; axis < 3; ++axis) {
      add(1U << axis, share_of((axis + 1) % 3) * share_of((axis + 2) % 3));
      add(7U ^ (1U << axis), share_of(axis));
    }
  }
  std::sort(sums.begin(), sums.end(),
            [](const SpringSum& l, const SpringSum& r) { return l.to < r.to; });
}

void add_cell_corners(const MaterialGrid& grid, const CornerNodes& nodes, std::uint32_t node,
                      MassSpringModel& model) {
  const std::size_t first = model.corners.size();
  for (unsigned o = 0; o < 8; ++o) {
    const std::uint32_t cell = nodes.around[node][o];
    if (cell == kNoIndex) continue;
    const std::array<std::uint32_t, 8>& of_cell = nodes.of_cell[cell];
    const unsigned here = 7 - o;
    add_corner(model, node, o, {of_cell[here ^ 1U], of_cell[here ^ 2U], of_cell[here ^ 4U]},
               grid.fraction_of(cell) * grid.materials[grid.material[cell]].young);
  }
  sort_corners(model, first);
}

MassSpringModel corners_model(const MaterialGrid& grid, const CornerNodes& nodes,
                              const LatticeOptions& options) {
  MassSpringModel model;
  model.materials = grid.materials;
  const auto count = static_cast<std::uint32_t>(nodes.at.size());
  for (std::uint32_t node = 0; node < count; ++node)
    add_corner_node(model, grid, nodes, node, options.bending);
  std::vector<SpringSum> sums;
  for (std::uint32_t node = 0; node < count; ++node) {
    gather_springs(grid, nodes, node, options.bending, sums);
    for (const SpringSum& sum : sums) add_spring(model, node, sum.to, sum.k, sum.c);
  }
  model.dilatation = cell_terms(grid, nodes);
  bind_surface(grid, nodes, model);
  if (!options.volumes) return model;
  model.corners.reserve(8 * grid.cells.size());
  for (std::uint32_t node = 0; node < count; ++node) add_cell_corners(grid, nodes, node, model);
  return model;
}

// ---------------------------------------------------------------- centers

// The 18 neighbours in grid order: the last 9 come after the cell.
constexpr std::array<CellIndex, 18> kNeighbours{{{0, -1, -1},
                                                 {-1, 0, -1},
                                                 {0, 0, -1},
                                                 {1, 0, -1},
                                                 {0, 1, -1},
                                                 {-1, -1, 0},
                                                 {0, -1, 0},
                                                 {1, -1, 0},
                                                 {-1, 0, 0},
                                                 {1, 0, 0},
                                                 {-1, 1, 0},
                                                 {0, 1, 0},
                                                 {1, 1, 0},
                                                 {0, -1, 1},
                                                 {-1, 0, 1},
                                                 {0, 0, 1},
                                                 {1, 0, 1},
                                                 {0, 1, 1}}};
constexpr std::size_t kFirstHigher = 9;

bool along_axis(const CellIndex& step) {
  return std::count(step.begin(), step.end(), 0) == 2;
}

struct SpringConstants {
  double k = 0;
  double c = 0;
};

// Two half springs 2 k1 and 2 k2 in series (docs/method.md, eq. 5). Their elongations are in the
// ratio k2 : k1. In slow motion, the half dampers 2 c1 and 2 c2 dissipate as much as one damper
// beta k, with beta the mean of both, each weighted with the k of the other: the softer half moves
// more and dissipates more.
SpringConstants series(const Material& m1, const Material& m2, double cell) {
  const double k1 = cell_stiffness(m1, cell);
  const double k2 = cell_stiffness(m2, cell);
  const double k = 2 * k1 * k2 / (k1 + k2);
  return {k, k * (m1.damping * k2 + m2.damping * k1) / (k1 + k2)};
}

void add_center_corners(const MaterialGrid& grid, const IndexLookup& lookup, std::uint32_t node,
                        MassSpringModel& model) {
  // Neighbours on the negative and on the positive side of each axis.
  std::array<std::array<std::uint32_t, 2>, 3> beside{};
  for (unsigned axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1}) {
      CellIndex at = grid.cells[node];
      at[axis] += 2 * side - 1;
      beside[axis][static_cast<unsigned>(side)] = lookup.find(at);
    }
  const std::size_t first = model.corners.size();
  for (unsigned o = 0; o < 8; ++o) {
    const std::uint32_t x = beside[0][o & 1U];
    const std::uint32_t y = beside[1][o >> 1U & 1U];
    const std::uint32_t z = beside[2][o >> 2U];
    if (x == kNoIndex || y == kNoIndex || z == kNoIndex) continue;
    add_corner(model, node, o, {x, y, z}, corner_young(model, {node, x, y, z}));
  }
  sort_corners(model, first);
}

MassSpringModel centers_model(const MaterialGrid& grid, bool volumes) {
  MassSpringModel model;
  model.materials = grid.materials;
  const IndexLookup lookup(grid.cells);
  const double face = grid.cell * grid.cell;
  const double volume = face * grid.cell;
  // Springs need the positions of higher nodes, so all nodes are added first.
  std::vector<std::array<std::uint32_t, kFirstHigher>> higher(grid.cells.size());
  for (std::size_t n = 0; n < grid.cells.size(); ++n) {
    const CellIndex& cell = grid.cells[n];
    double area = 0;
    bool border = false;
    for (std::size_t i = 0; i < kNeighbours.size(); ++i) {
      const CellIndex& step = kNeighbours[i];
      const std::uint32_t other =
          lookup.find({cell[0] + step[0], cell[1] + step[1], cell[2] + step[2]});
      if (i >= kFirstHigher) higher[n][i - kFirstHigher] = other;
      if (other != kNoIndex) continue;
      border = true;
      if (along_axis(step)) area += face;
    }
    add_node(model, grid.center(cell), grid.materials[grid.material[n]].density * volume, volume,
             area, border, grid.material[n]);
  }
  for (std::uint32_t n = 0; n < model.node_count(); ++n)
    for (const std::uint32_t other : higher[n]) {
      if (other == kNoIndex) continue;
      const Material& here = grid.materials[grid.material[n]];
      const double k = cell_stiffness(here, grid.cell);
      const SpringConstants spring =
          grid.material[n] == grid.material[other]
              ? SpringConstants{k, here.damping * k}
              : series(here, grid.materials[grid.material[other]], grid.cell);
      add_spring(model, n, other, spring.k, spring.c);
    }
  model.dilatation = material_terms(model);
  if (volumes)
    for (std::uint32_t n = 0; n < model.node_count(); ++n)
      add_center_corners(grid, lookup, n, model);
  return model;
}

void require_buildable(const MaterialGrid& grid) {
  validate(grid);
  if (grid.cells.empty())
    throw InputError("lattice: the grid has no filled cells; use smaller cells");
  // A cell makes at most 8 nodes, and nodes are counted in 32 bits.
  if (grid.cells.size() > std::numeric_limits<std::uint32_t>::max() / 8)
    throw InputError(
        fmt::format("lattice: {} cells are too many; use larger cells", grid.cells.size()));
}

void require_memory_for(std::size_t nodes, const MaterialGrid& grid) {
  const auto cells = static_cast<double>(grid.cells.size());
  require_memory_of_cells("lattice", cells,
                          kLatticeBytesPerNode * static_cast<double>(nodes) / cells, grid.cell);
}

LatticeModel build_corners(MaterialGrid grid, const LatticeOptions& options) {
  LatticeModel lattice;
  CornerNodes nodes = corner_nodes(grid.cells);
  lattice.hinges = find_hinges(grid, nodes);
  if (!lattice.hinges.empty() && options.hinges == HingePolicy::fill) {
    lattice.filled_cells = fill_hinges(grid);
    nodes = corner_nodes(grid.cells);
  }
  if (!lattice.hinges.empty() && options.hinges == HingePolicy::separate)
    nodes = separate_clusters(nodes);
  require_memory_for(nodes.at.size(), grid);
  lattice.model = corners_model(grid, nodes, options);
  return lattice;
}

}  // namespace

LatticeModel build_lattice(const MaterialGrid& grid, const LatticeOptions& options) {
  require_buildable(grid);
  if (options.style == LatticeStyle::centers && options.bending == Bending::corrected)
    throw InputError(
        "lattice: bending = \"corrected\" is for style = \"corners\"; leave one of both out");
  if (options.style == LatticeStyle::centers && !grid.fraction.empty())
    throw InputError(
        "lattice: cut cells are for style = \"corners\"; make the grid without cut_cells");
  require_memory_for(grid.cells.size(), grid);
  LatticeModel lattice;
  if (options.style == LatticeStyle::corners)
    lattice = build_corners(grid, options);
  else
    lattice.model = centers_model(grid, options.volumes);
  validate(lattice.model);
  lattice.components = connected_components(lattice.model).count;
  return lattice;
}

}  // namespace springlod::voxelize
