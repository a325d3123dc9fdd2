#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <hwy/aligned_allocator.h>

#include "sim/fast/kernels.hpp"
#include "sim/fast/row_layout.hpp"

namespace springlod::sim {

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

template <class Real>
using RowKernels = FastKernels<RowLayout<Real>, RowState<Real>>;

/// For the widest vectors that this processor has.
template <class Real>
RowKernels<Real> row_kernels();

}  // namespace springlod::sim
