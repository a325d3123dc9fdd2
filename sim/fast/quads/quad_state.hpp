#pragma once

#include <cstdint>
#include <vector>

#include "sim/fast/kernels.hpp"
#include "sim/fast/quads/quad_layout.hpp"

namespace springlod::sim {

/// The state of one node, loaded at once: 32 bytes (float) or 64 (double). The padding stays 0.
template <class Real>
struct alignas(8 * sizeof(Real)) NodeRecord {
  Real x[4] = {};  ///< [m]
  Real v[4] = {};  ///< [m/s]
};

template <class Real>
struct alignas(4 * sizeof(Real)) NodeVector {
  Real at[4] = {};
};

/// The changing data of a block of quads, by index in the block (see QuadBlock).
template <class Real>
struct QuadBlockState {
  std::vector<NodeRecord<Real>> records;
  std::vector<NodeVector<Real>> forces;          ///< [N]
  std::vector<NodeVector<Real>> damping_forces;  ///< their damping part; may be empty
  /// Part of the own nodes' positions below the last bit of x [m], where the displacement of a step
  /// often lies. Empty in double precision.
  std::vector<NodeVector<Real>> low;
  std::vector<Real> counts;                  ///< by own node: 1 if its departure counts, else 0
  Box3 bounds;                               ///< of the own nodes [m]
  Vec3 largest_displacement = Vec3::Zero();  ///< see FastBody [m]
  CornerDues corner_dues;                    ///< of the eights of corners
};

template <class Real>
using QuadState = std::vector<QuadBlockState<Real>>;

template <class Real>
using QuadKernels = FastKernels<QuadLayout<Real>, QuadState<Real>>;

/// The kernels for the widest vectors of this processor.
template <class Real>
QuadKernels<Real> quad_kernels();

}  // namespace springlod::sim
