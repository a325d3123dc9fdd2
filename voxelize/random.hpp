#pragma once

#include <cstdint>
#include <optional>

#include "base/option.hpp"
#include "base/progress.hpp"
#include "model/mass_spring.hpp"
#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// Ends of springs that every node of a random model has at least.
inline constexpr std::uint32_t kLeastRandomEnds = 14;

struct RandomOptions {
  /// Nodes to place; left out: as many as `spacing` asks for.
  std::optional<std::uint32_t> nodes{};
  /// Edge of the cube that a node stands for [m]: volume / spacing^3 nodes. Both left out: the edge
  /// of a cell.
  std::optional<double> spacing{};
  /// Spring ends a node on average (18: as many as a node inside a lattice has), at least 14. As
  /// nodes of the surface must have 14 too, the mean of a model that is mostly surface comes out
  /// higher than 14.
  double ends = 18;
  std::uint64_t seed = 1;
  /// One factor for all springs, from a solved stretch test.
  bool rescale = true;
  Progress* progress = nullptr;
};
inline constexpr const char* kEndsHelp =
    "ends of springs a node on average, at least 14; every node of a random model has 14";
inline constexpr const char* kPlacesHelp =
    "of the random places; the same seed gives the same bits";
constexpr auto option_rows(const RandomOptions*) {
  return std::tuple(
      option("nodes", &RandomOptions::nodes, "how many, at least 15")
          .by_default("as spacing tells"),
      option("spacing", &RandomOptions::spacing, "edge of the cube that a node stands for")
          .in(Dimension::length)
          .by_default("the grid's cell"),
      option("ends", &RandomOptions::ends, kEndsHelp),
      option("seed", &RandomOptions::seed, kPlacesHelp),
      option("rescale", &RandomOptions::rescale,
             "one factor for all springs from a solved stretch test, so that the model shows its "
             "E; false: k by eq. 2 of the paper alone"));
}

/// A random model and what was measured of its network, the same nodes and springs all of one
/// material: in a box of cells the mean of the stretch tests along its three edges, in any other
/// shape the answer to the tractions of uniform stress (surface_stretch). Its Young's modulus is
/// told as a part of what was asked for.
struct RandomModel {
  MassSpringModel model;
  double eq2_young = 0;  ///< before the rescale, as k is chosen by eq. 2 of the paper
  double young = 0;      ///< with the rescale: 1, but for the solver's residual
  double poisson = 0;    ///< no rescale changes it
  double rescaled = 1;   ///< factor of every stiffness and damping
  double mean_ends = 0;
  std::uint32_t least_ends = 0;
  std::uint32_t parts = 0;  ///< connected parts of the model
};

/// Nodes spread as blue noise through the solid, some of them on its surface, each joined with its
/// nearest (docs/method.md, section 2). Masses, volumes and contact areas: each small piece of a
/// cell or of an exposed face goes to the nearest node (of the surface, for faces), so they add up
/// to those of the grid. k is chosen by eq. 2 of the paper node by node (unit_stiffness) and then
/// times one number for the whole network, the rescale; between nodes of two materials E is the
/// harmonic mean, as in a `centers` lattice. A node's material is that of most of its volume.
/// Border: the nodes on the surface.
///
/// Nodes are in the order (z, y, x). The same seed gives the same bits. Throws InputError: an empty
/// grid, fewer than 15 nodes or more than the cells have room for, fewer than 14 ends.
RandomModel build_random(const MaterialGrid& grid, const RandomOptions& options = {});

}  // namespace springlod::voxelize
