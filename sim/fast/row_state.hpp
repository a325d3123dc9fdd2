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

  explicit RowState(const RowLayout<Real>& layout);

  Coordinates x;  ///< [m]
  Coordinates v;  ///< [m/s]
  /// What x is too coarse to hold [m]: a step's way is often less than the last bit of a place.
  /// Unused in double precision.
  Coordinates low;
  /// Forces that a block works out on its own places and those of its reach [N]; by block.
  std::vector<Coordinates> force;
  std::vector<Box3> bounds;  ///< of the places of each block [m]
};

/// Works out the springs of a block: k (l - L) + c dl/dt along each, into `force` of the block.
void find_row_forces(const RowLayout<float>& layout, std::uint32_t block, RowState<float>& state);
void find_row_forces(const RowLayout<double>& layout, std::uint32_t block, RowState<double>& state);

/// Once all forces are known: v += kick f / m, then x += drift v for the block's nodes, and their
/// bounds. kick and drift: [s].
void move_rows(const RowLayout<float>& layout, std::uint32_t block, double kick, double drift,
               RowState<float>& state);
void move_rows(const RowLayout<double>& layout, std::uint32_t block, double kick, double drift,
               RowState<double>& state);

}  // namespace springlod
