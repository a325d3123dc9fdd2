#pragma once

#include <cstdint>
#include <optional>

#include "base/option.hpp"
#include "base/progress.hpp"
#include "model/mass_spring.hpp"
#include "voxelize/grid.hpp"
#include "voxelize/lattice/lattice.hpp"

namespace springlod::voxelize {

/// Least number of spring ends at every node of a random model (docs/method.md, section 2).
inline constexpr std::uint32_t kLeastRandomEnds = 14;
/// Largest number of nodes: the samples that place them take 2.3 GB.
inline constexpr double kMostRandomNodes = 2e6;

struct RandomOptions {
  /// Number of nodes; default: volume / spacing^3.
  std::optional<std::uint32_t> nodes{};
  /// Edge of the cube that a node represents [m]; default: the edge of a cell.
  std::optional<double> spacing{};
  /// Mean number of spring ends at a node, at least 14 (18 as at a node inside a lattice). Surface
  /// nodes need 14 too, so a model that is mostly surface has a higher mean than 14.
  double ends = 18;
  std::uint64_t seed = 1;
  /// Scale all springs by one factor, measured by a stretch test; with a Poisson's ratio other than
  /// 1/4, springs and dilatation terms by two, until E and nu are those of the material.
  bool rescale = true;
  /// Whether the model gets corners (choose_corners of voxelize/random_corners.hpp).
  bool volumes = true;
  Progress* progress = nullptr;
};
inline constexpr const char* kEndsHelp =
    "mean number of spring ends per node, at least 14; every node has at least 14";
inline constexpr const char* kPlacesHelp =
    "seed of the random positions; the same seed gives the same bits";
constexpr auto option_rows(const RandomOptions*) {
  return std::tuple(
      option("nodes", &RandomOptions::nodes, "number of nodes")
          .within(kLeastRandomEnds + 1, kMostRandomNodes)
          .by_default("from spacing"),
      option("spacing", &RandomOptions::spacing, "edge of the cube that a node represents")
          .within(1e-9, 1e6)
          .in(Dimension::length)
          .by_default("the grid's cell"),
      option("ends", &RandomOptions::ends, kEndsHelp).within(kLeastRandomEnds, 1000),
      option("seed", &RandomOptions::seed, kPlacesHelp),
      option("rescale", &RandomOptions::rescale,
             "scale all springs by one factor from a stretch test, so that the model has its "
             "material's Young's modulus; false: stiffnesses by eq. 2 of the paper"),
      option("volumes", &RandomOptions::volumes, kVolumesHelp));
}

/// A random model and the measured moduli of its network, taken with one material for all springs,
/// the one that most nodes have: in a box of cells the means of the stretch tests along its
/// three edges, in any other shape those of surface_stretch. Young's moduli are fractions of the
/// target.
struct RandomModel {
  MassSpringModel model;
  double eq2_young = 0;  ///< before rescaling, with k by eq. 2
  double young = 0;      ///< after rescaling: 1 up to the solver's residual, without terms
  double poisson = 0;    ///< after rescaling
  double rescaled = 1;   ///< factor of all stiffnesses and damping coefficients
  double mean_ends = 0;
  std::uint32_t least_ends = 0;
  std::uint32_t components = 0;  ///< number of connected components
};

/// Builds a random model (docs/method.md, eqs. 6 to 8): blue-noise nodes inside the solid and on
/// its surface, each connected with its nearest ones. Masses, volumes and contact areas are those
/// of small samples of the cells and exposed faces: each sample belongs to its nearest node (faces:
/// surface node), so the sums are those of the grid. k satisfies eq. 2 at each node
/// (unit_stiffness) and is then multiplied by one factor for the whole network; a node of a
/// material with nu other than 1/4 has a dilatation term, and then each nu has its own two factors.
/// Between two materials E is the harmonic mean, as in a `centers` lattice. The material of a node
/// is that of most of its volume. Border nodes are the nodes on the surface.
///
/// Of a grid of cut cells, those of which at least half is inside count, as whole ones. Nodes are
/// in the order (z, y, x). The same seed gives the same bits. Throws InputError: an empty
/// grid, fewer than 15 nodes or more than the cells have room for, fewer than 14 ends.
RandomModel build_random(const MaterialGrid& grid, const RandomOptions& options = {});

}  // namespace springlod::voxelize
