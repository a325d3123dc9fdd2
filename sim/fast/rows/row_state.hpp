#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <hwy/aligned_allocator.h>

#include "sim/fast/kernels.hpp"
#include "sim/fast/rows/row_layout.hpp"

namespace springlod::sim {

/// The changing data of a body in rows, by place. Each coordinate is one array, padded so that a
/// whole row can be loaded at any place.
template <class Real>
struct RowState {
  using Array = hwy::AlignedFreeUniquePtr<Real[]>;
  using Coordinates = std::array<Array, 3>;

  RowState(const RowLayout<Real>& layout, bool with_damping);

  Coordinates x;  ///< [m]
  Coordinates v;  ///< [m/s]
  /// Part of the positions below the last bit of x [m], where the displacement of a step often
  /// lies. Unused in double precision.
  Coordinates low;
  Array counts;  ///< 1 for a node whose departure counts, 0 for another and for padding
  /// Forces that a block computes on its own places and those in its reach [N]; by block.
  std::vector<Coordinates> force;
  std::vector<Coordinates> damping_force;  ///< its damping part; empty if not requested
  std::vector<Box3> bounds;                ///< bounds of the places of each block [m]
  std::vector<Vec3> largest_displacement;  ///< see FastBody; by block [m]
  std::vector<CornerDues> corner_dues;     ///< of the stars; by block
};

template <class Real>
using RowKernels = FastKernels<RowLayout<Real>, RowState<Real>>;

/// The kernels for the widest vectors of this processor.
template <class Real>
RowKernels<Real> row_kernels();

}  // namespace springlod::sim
