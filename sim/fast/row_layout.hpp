#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/fast/place.hpp"

namespace springlod::sim {

/// Springs or nodes in one vector operation [lanes].
inline constexpr std::uint32_t kRowLanes = 8;

/// Springs from eight consecutive places to the eight that lie `ahead` places further on.
struct SpringRow {
  std::uint32_t ahead = 0;
  std::uint32_t properties = 0;  ///< index into RowLayout::properties
};

/// Properties of the eight springs of a row; all 0 for a missing spring.
template <class Real>
struct RowProperties {
  Real stiffness[kRowLanes] = {};   ///< k [N/m]
  Real rest_force[kRowLanes] = {};  ///< k L [N]
  Real damping[kRowLanes] = {};     ///< c [N s/m]
  bool operator==(const RowProperties&) const = default;
};

/// Consecutive places whose rows one thread computes.
struct RowBlock {
  std::uint32_t first = 0;  ///< place, a multiple of kRowLanes
  std::uint32_t own = 0;    ///< places
  std::uint32_t reach = 0;  ///< places after its own at which its springs end, in whole rows
  /// Own places, padded to whole rows.
  std::uint32_t places() const { return (own + kRowLanes - 1) / kRowLanes * kRowLanes; }
};

/// A lattice laid out for fast steps. Nodes are sorted by layer, line and column, so that the
/// neighbours of adjacent nodes are adjacent too. Eight springs of one direction form a *row*,
/// whose ends are contiguous in memory and need no gather. Each spring is computed once, from its
/// first node. Rows with equal properties share them: 1 to 2 bytes per spring.
template <class Real>
struct RowLayout {
  std::vector<std::uint32_t> node;       ///< node at each place; N
  std::vector<std::uint32_t> first_row;  ///< first row of each eight places, and the end
  std::vector<SpringRow> rows;           ///< in the order of the places
  std::vector<RowProperties<Real>> properties;
  std::vector<RowBlock> blocks;
  std::vector<Place> place;        ///< place of each node; N
  std::vector<Real> inverse_mass;  ///< by place, padded with 0 to a multiple of kRowLanes [1/kg]
  std::uint32_t reach = 0;         ///< largest reach of a block

  std::uint32_t block_places = 0;  ///< places of every block but the last

  /// The first block whose springs may end at places of this block.
  std::uint32_t first_contributor(std::uint32_t block) const {
    const std::uint32_t back = (reach + block_places - 1) / block_places;
    return block > back ? block - back : 0;
  }
};

template <class Real>
RowLayout<Real> make_row_layout(const MassSpringModel& model);

}  // namespace springlod::sim
