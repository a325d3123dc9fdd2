#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.hpp"
#include "model/chain.hpp"
#include "voxelize/grid.hpp"
#include "voxelize/lattice.hpp"

namespace springlod {

/// What the volume is refilled with.
enum class RefillStyle { lattice, random };

struct RefillOptions {
  /// Nodes wanted at level 1, 2, ..., each fewer than before. A random model has exactly as many; a
  /// lattice comes as near as the size of its cells allows.
  std::vector<std::uint32_t> nodes;
  RefillStyle style = RefillStyle::lattice;
  LatticeStyle lattice = LatticeStyle::corners;
  double ends = 18;        ///< of springs a node, random
  std::uint64_t seed = 1;  ///< random
  Progress* progress = nullptr;
};

/// Global rescaling (the paper, section 4.1): level 0 is `base`, made on `grid`; each coarser level
/// is a model of its own, made anew on the same volume. No nodes are merged: every node of the base
/// is told to the nearest node of a level (and a node that is nearest to none gets its nearest
/// one).
///
/// For a lattice the grid is sampled at the centres of larger cells, laid around the middle of its
/// box, and mended where cells come to touch along an edge only (HingePolicy::fill); the model is
/// then resized and moved, its masses scaled, so that volume, mass and centre of mass are those of
/// the grid, with E by eq. 2 of the paper kept. Throws InputError: no nodes wanted, a level no
/// coarser than the one before, what build_lattice and build_random throw.
LodChain refill(const MassSpringModel& base, const MaterialGrid& grid,
                const RefillOptions& options);

/// The lattice whose number of nodes comes nearest to `nodes`.
MassSpringModel lattice_of_about(const MaterialGrid& grid, std::uint32_t nodes, LatticeStyle style);

}  // namespace springlod
