#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.hpp"
#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// Places evenly spread over a grid: the volume and the surface of its filled cells in small equal
/// pieces.
struct GridSamples {
  std::vector<Vec3> inner;                ///< middles of equal parts of the filled cells [m]
  std::vector<std::uint32_t> inner_cell;  ///< the cell of each
  double inner_volume = 0;                ///< that each stands for [m3]

  std::vector<Vec3> outer;                ///< middles of equal parts of the exposed faces [m]
  std::vector<std::uint32_t> outer_cell;  ///< the filled cell behind each
  std::vector<Vec3> outward;              ///< unit normal of its face
  double outer_area = 0;                  ///< that each stands for [m2]

  Box3 box;           ///< of the filled cells [m]
  double volume = 0;  ///< of the filled cells [m3]
};
/// About `per_node` samples of the volume for each of `nodes` nodes, and as dense on the surface;
/// at least one a cell and a face.
GridSamples sample_grid(const MaterialGrid& grid, std::uint32_t nodes, double per_node);

/// Nodes of a random model: first those on the surface, in the middle of a piece of an exposed
/// face, then those inside.
struct RandomNodes {
  std::vector<Vec3> at;             ///< [m]
  std::vector<std::uint32_t> cell;  ///< the filled cell each is in, or lies on the surface of
  std::uint32_t outer = 0;          ///< how many are on the surface
  double spacing = 0;               ///< edge of the cube that a node inside stands for [m]
};

/// Spreads exactly `nodes` nodes as blue noise: darts thrown on the surface and then into the
/// volume (maximal Poisson-disk sampling, Cook 1986), with the disk that makes their number come
/// out; then Lloyd's relaxation (1982), in which nodes of the surface stay on it and the others in
/// the solid. The same seed gives the same bits. Throws InputError if the samples are too few.
RandomNodes place_nodes(const MaterialGrid& grid, const GridSamples& samples, std::uint32_t nodes,
                        std::uint64_t seed, Progress* progress);

}  // namespace springlod::voxelize
