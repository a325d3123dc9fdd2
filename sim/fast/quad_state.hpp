#pragma once

#include <cstdint>
#include <vector>

#include "sim/fast/kernels.hpp"
#include "sim/fast/quad_layout.hpp"

namespace springlod::sim {

/// What a step needs of one node, in one load: 32 bytes (float) or 64 (double). The numbers that
/// fill it up stay 0.
template <class Real>
struct alignas(8 * sizeof(Real)) NodeRecord {
  Real x[4] = {};  ///< [m]
  Real v[4] = {};  ///< [m/s]
};

template <class Real>
struct alignas(4 * sizeof(Real)) NodeVector {
  Real at[4] = {};
};

/// What moves of a block of quads, by index within it: see QuadBlock.
template <class Real>
struct QuadBlockState {
  std::vector<NodeRecord<Real>> records;
  std::vector<NodeVector<Real>> forces;          ///< [N]
  std::vector<NodeVector<Real>> damping_forces;  ///< the part of them that is damping; may be empty
  /// What x of own nodes is too coarse to hold [m]: a step's way is often less than the last bit of
  /// a place. Empty in double precision.
  std::vector<NodeVector<Real>> low;
  Box3 bounds;  ///< of the own nodes [m]
};

template <class Real>
using QuadState = std::vector<QuadBlockState<Real>>;

template <class Real>
using QuadKernels = FastKernels<QuadLayout<Real>, QuadState<Real>>;

/// For the widest vectors that this processor has.
template <class Real>
QuadKernels<Real> quad_kernels();

}  // namespace springlod::sim
