#pragma once

#include <cstdint>
#include <vector>

#include "base/choice.hpp"
#include "base/option.hpp"
#include "base/progress.hpp"
#include "model/chain.hpp"
#include "voxelize/grid.hpp"
#include "voxelize/lattice.hpp"
#include "voxelize/random.hpp"

namespace springlod::voxelize {

/// What the volume is refilled with.
enum class RefillStyle { lattice, random };

inline constexpr Choice<RefillStyle> kRefillStyles[] = {
    {RefillStyle::lattice, "lattice", "nodes of a lattice of larger cells"},
    {RefillStyle::random, "random", "nodes at random places, joined as s.random joins them"}};
constexpr ChoiceTable<Choice<RefillStyle>> choices(RefillStyle) {
  return {"refill", kRefillStyles};
}

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
constexpr auto option_rows(const RefillOptions*) {
  return std::tuple(option("style", &RefillOptions::style, "what the levels are made of"),
                    option("lattice", &RefillOptions::lattice,
                           "where the nodes of a lattice sit, as in s.lattice"),
                    option("ends", &RefillOptions::ends, kEndsHelp),
                    option("seed", &RefillOptions::seed, kPlacesHelp));
}

/// Models of the volume of `grid`, each of about as many nodes as wanted: levels of a chain, but
/// for the map from its base, which lod's refill makes.
///
/// For a lattice the grid is sampled at the centres of larger cells, laid around the middle of its
/// box, and mended where cells come to touch along an edge only (HingePolicy::fill); the model is
/// then resized and moved, its masses scaled, so that volume, mass and centre of mass are those of
/// the grid, with E by eq. 2 of the paper kept. Throws InputError: no nodes wanted,
/// what build_lattice and build_random throw.
std::vector<Level> refill_levels(const MaterialGrid& grid, const RefillOptions& options);

/// The lattice whose number of nodes comes nearest to `nodes`.
MassSpringModel lattice_of_about(const MaterialGrid& grid, std::uint32_t nodes, LatticeStyle style);

}  // namespace springlod::voxelize
