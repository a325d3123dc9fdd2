#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.hpp"
#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// Samples of a grid: the centres of small equal fractions of its volume and its surface.
struct GridSamples {
  std::vector<Vec3> inner;                ///< centres of equal fractions of the filled cells [m]
  std::vector<std::uint32_t> inner_cell;  ///< the cell of each sample
  double inner_volume = 0;                ///< of one sample [m3]

  std::vector<Vec3> outer;                ///< centres of equal fractions of the exposed faces [m]
  std::vector<std::uint32_t> outer_cell;  ///< the filled cell behind each sample
  std::vector<Vec3> outward;              ///< unit normal of its face
  double outer_area = 0;                  ///< of one sample [m2]

  Box3 box;           ///< of the filled cells [m]
  double volume = 0;  ///< of the filled cells [m3]
};
/// Makes about `per_node` samples of the volume for each of `nodes` nodes, twice as dense along
/// each axis on the surface; at least one for each cell and face.
GridSamples sample_grid(const MaterialGrid& grid, std::uint32_t nodes, double per_node);

/// Nodes of a random model: first those on the surface, then those inside.
struct RandomNodes {
  std::vector<Vec3> at;             ///< [m]
  std::vector<std::uint32_t> cell;  ///< the filled cell that each is in or on
  std::uint32_t outer = 0;          ///< number of nodes on the surface
  double spacing = 0;               ///< edge of the cube that an inner node represents [m]
};

/// Places exactly `nodes` nodes as blue noise by maximal Poisson-disk sampling (Cook 1986), first
/// on the surface and then in the volume, with the disk radius that gives their number; then
/// Lloyd's relaxation (1982), which keeps surface nodes on the surface and inner nodes in the
/// solid. The same seed gives the same bits. Throws InputError for fewer samples than nodes.
RandomNodes place_nodes(const MaterialGrid& grid, const GridSamples& samples, std::uint32_t nodes,
                        std::uint64_t seed, Progress* progress);

}  // namespace springlod::voxelize
