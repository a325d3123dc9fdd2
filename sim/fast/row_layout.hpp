#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/fast/place.hpp"

namespace springlod::sim {

/// Springs and nodes processed in parallel [lanes].
inline constexpr std::uint32_t kRowLanes = 8;

/// Springs from eight consecutive nodes to the eight nodes that are `ahead` positions later in the
/// order.
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

/// Consecutive nodes whose rows are evaluated by one thread.
struct RowBlock {
  std::uint32_t first = 0;  ///< index, a multiple of kRowLanes
  std::uint32_t own = 0;    ///< places
  std::uint32_t reach = 0;  ///< number of later nodes that its rows reach, rounded up to whole rows
  /// Number of its own nodes, padded to whole rows.
  std::uint32_t places() const { return (own + kRowLanes - 1) / kRowLanes * kRowLanes; }
};

/// A lattice in row layout. Nodes are sorted by layer, line and column, so that the neighbours of
/// adjacent nodes are adjacent too. Eight springs of one direction form a *row*, whose ends are
/// contiguous in memory and need no gather. Each spring is evaluated once, from its first node.
/// Rows with equal properties share them: 1 to 2 bytes per spring.
template <class Real>
struct RowLayout {
  std::vector<std::uint32_t> node;       ///< of each place; N
  std::vector<std::uint32_t> first_row;  ///< first row of each eight nodes, and the end
  std::vector<SpringRow> rows;           ///< in the order of the layout
  std::vector<RowProperties<Real>> properties;
  std::vector<RowBlock> blocks;
  std::vector<Place> place;        ///< of each node; N
  std::vector<Real> inverse_mass;  ///< by index, padded with 0 to a multiple of kRowLanes [1/kg]
  std::uint32_t reach = 0;         ///< largest of the blocks

  std::uint32_t block_places = 0;  ///< of every block but the last

  /// The first block whose springs may reach the nodes of this one.
  std::uint32_t first_contributor(std::uint32_t block) const {
    const std::uint32_t back = (reach + block_places - 1) / block_places;
    return block > back ? block - back : 0;
  }
};

template <class Real>
RowLayout<Real> make_row_layout(const MassSpringModel& model);

}  // namespace springlod::sim
