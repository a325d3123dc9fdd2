#pragma once

#include <cstdint>
#include <vector>

#include "sim/fast/kernels.hpp"
#include "sim/fast/quad_layout.hpp"

namespace springlod::sim {

/// The data of one node that a step needs, in one load: 32 bytes (float) or 64 (double). The
/// padding stays 0.
template <class Real>
struct alignas(8 * sizeof(Real)) NodeRecord {
  Real x[4] = {};  ///< [m]
  Real v[4] = {};  ///< [m/s]
};

template <class Real>
struct alignas(4 * sizeof(Real)) NodeVector {
  Real at[4] = {};
};

/// The state of a block of quads, by index within the block: see QuadBlock.
template <class Real>
struct QuadBlockState {
  std::vector<NodeRecord<Real>> records;
  std::vector<NodeVector<Real>> forces;          ///< [N]
  std::vector<NodeVector<Real>> damping_forces;  ///< their damping components; may be empty
  /// Accumulated rounding errors of x of own nodes [m]: the displacement in a step is often smaller
  /// than the last bit of x. Empty in double precision.
  std::vector<NodeVector<Real>> low;
  Box3 bounds;  ///< of the own nodes [m]
};

template <class Real>
using QuadState = std::vector<QuadBlockState<Real>>;

template <class Real>
using QuadKernels = FastKernels<QuadLayout<Real>, QuadState<Real>>;

/// Kernels for the widest SIMD vectors of this processor.
template <class Real>
QuadKernels<Real> quad_kernels();

}  // namespace springlod::sim
