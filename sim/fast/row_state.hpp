#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <hwy/aligned_allocator.h>

#include "sim/fast/row_layout.hpp"

namespace springlod {

/// What moves of a body laid out in rows, by place. One array a coordinate, long enough that a row
/// may be loaded whole anywhere.
template <class Real>
struct RowState {
  using Array = hwy::AlignedFreeUniquePtr<Real[]>;
  using Coordinates = std::array<Array, 3>;

  RowState(const RowLayout<Real>& layout, bool with_damping);

  Coordinates x;  ///< [m]
  Coordinates v;  ///< [m/s]
  /// What x is too coarse to hold [m]: a step's way is often less than the last bit of a place.
  /// Unused in double precision.
  Coordinates low;
  /// Forces that a block works out on its own places and those of its reach [N]; by block.
  std::vector<Coordinates> force;
  std::vector<Coordinates>
      damping_force;         ///< the part of it that is damping; empty if not asked for
  std::vector<Box3> bounds;  ///< of the places of each block [m]
};

/// Works out the springs of a block: k (l - L) + c dl/dt along each, into its forces.
template <class Real>
void find_row_forces(const RowLayout<Real>& layout, std::uint32_t block, RowState<Real>& state);
/// Adds what earlier blocks worked out on this one's places to its own.
template <class Real>
void collect_row_forces(const RowLayout<Real>& layout, std::uint32_t block, RowState<Real>& state);
/// Sum of damping force times velocity over the places of the block [W], once collected.
template <class Real>
double row_damping_power(const RowLayout<Real>& layout, std::uint32_t block,
                         const RowState<Real>& state);
/// v += kick f / m, then x += drift v for the block's nodes, and their bounds; with 0 seconds of
/// either, that part is left out.
template <class Real>
void move_rows(const RowLayout<Real>& layout, std::uint32_t block, double kick, double drift,
               RowState<Real>& state);

/// Appends the indices of the block's own nodes that lie within the region, rising.
template <class Real>
void find_row_nodes(const RowLayout<Real>& layout, std::uint32_t block, const RowState<Real>& state,
                    const Box3& region, std::vector<std::uint32_t>& indices);

}  // namespace springlod
