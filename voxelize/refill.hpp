#pragma once

#include <cstdint>
#include <vector>

#include "base/choice.hpp"
#include "base/option.hpp"
#include "base/progress.hpp"
#include "model/chain.hpp"
#include "voxelize/grid.hpp"
#include "voxelize/lattice/lattice.hpp"
#include "voxelize/random/random.hpp"

namespace springlod::voxelize {

/// Model that refills the volume.
enum class RefillStyle { lattice, random };

inline constexpr Choice<RefillStyle> kRefillStyles[] = {
    {RefillStyle::lattice, "lattice", "nodes of a lattice of larger cells"},
    {RefillStyle::random, "random", "nodes at random positions, connected as in s.random"}};
constexpr ChoiceTable<Choice<RefillStyle>> choices(RefillStyle) {
  return {"refill", kRefillStyles};
}

struct RefillOptions {
  /// Number of nodes of level 1, 2, ..., decreasing. A random model has exactly this number; a
  /// lattice has the closest number that its cell size permits.
  std::vector<std::uint32_t> nodes;
  RefillStyle style = RefillStyle::lattice;
  LatticeStyle lattice = LatticeStyle::corners;
  double ends = 18;        ///< mean number of spring ends at a node (random)
  std::uint64_t seed = 1;  ///< of a random model
  bool volumes = true;     ///< whether the levels get corners, as in the builders
  Progress* progress = nullptr;
};
constexpr auto option_rows(const RefillOptions*) {
  return std::tuple(option("style", &RefillOptions::style, "structure of the levels"),
                    option("lattice", &RefillOptions::lattice,
                           "position of the nodes of a lattice, as in s.lattice"),
                    option("ends", &RefillOptions::ends, kEndsHelp).within(kLeastRandomEnds, 1000),
                    option("seed", &RefillOptions::seed, kPlacesHelp),
                    option("volumes", &RefillOptions::volumes, kVolumesHelp));
}

/// New models of the volume of `grid`, one of about each wanted number of nodes: the levels of a
/// chain without the maps from its base, which lod's refill adds.
///
/// Of a grid of cut cells, those of which at least half is inside count, as whole ones. For a
/// lattice the grid is sampled at the centres of larger cells, laid around the centre of its
/// bounding box, and hinges are filled (HingePolicy::fill). The model is then scaled and translated
/// so that its volume, mass and centre of mass are those of the grid; E by eq. 2 of the paper is
/// kept. Throws InputError if a level of no nodes is wanted, and where build_lattice and
/// build_random throw.
std::vector<Level> refill_levels(const MaterialGrid& grid, const RefillOptions& options);

/// The lattice whose number of nodes is closest to `nodes`; `volumes` as in LatticeOptions.
MassSpringModel lattice_of_about(const MaterialGrid& grid, std::uint32_t nodes, LatticeStyle style,
                                 bool volumes = true);

}  // namespace springlod::voxelize
