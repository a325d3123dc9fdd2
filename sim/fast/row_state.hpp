#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <hwy/aligned_allocator.h>

#include "sim/fast/kernels.hpp"
#include "sim/fast/row_layout.hpp"

namespace springlod::sim {

/// The state of a body in row layout, by index. One array per coordinate, padded so that a whole
/// row may be loaded at any index.
template <class Real>
struct RowState {
  using Array = hwy::AlignedFreeUniquePtr<Real[]>;
  using Coordinates = std::array<Array, 3>;

  RowState(const RowLayout<Real>& layout, bool with_damping);

  Coordinates x;  ///< [m]
  Coordinates v;  ///< [m/s]
  /// Accumulated rounding errors of x [m]: the displacement in a step is often smaller than the
  /// last bit of x. Unused in double precision.
  Coordinates low;
  /// Forces that a block computes on its own nodes and those within its reach [N]; by block.
  std::vector<Coordinates> force;
  std::vector<Coordinates> damping_force;  ///< its damping component; empty if not requested
  std::vector<Box3> bounds;                ///< bounds of the nodes of each block [m]
};

template <class Real>
using RowKernels = FastKernels<RowLayout<Real>, RowState<Real>>;

/// Kernels for the widest SIMD vectors of this processor.
template <class Real>
RowKernels<Real> row_kernels();

}  // namespace springlod::sim
