#pragma once

#include <cstdint>
#include <vector>

#include "sim/fast/quad_layout.hpp"

namespace springlod {

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
  std::vector<NodeVector<Real>> forces;  ///< [N]; 0 before forces are found
  /// What x of own nodes is too coarse to hold [m]: a step's way is often less than the last bit of
  /// a place. Empty in double precision.
  std::vector<NodeVector<Real>> low;
  Box3 bounds;  ///< of the own nodes [m]
};

template <class Real>
using QuadState = std::vector<QuadBlockState<Real>>;

/// Copies the halo of a block and works out its springs: k (l - L) + c dl/dt along each, added to
/// the forces of both ends.
void find_quad_forces(const QuadLayout<float>& layout, std::uint32_t block,
                      QuadState<float>& state);
void find_quad_forces(const QuadLayout<double>& layout, std::uint32_t block,
                      QuadState<double>& state);

/// Once all forces are known: v += kick f / m, then x += drift v for the block's nodes, and their
/// bounds. kick and drift: [s].
void move_quads(const QuadLayout<float>& layout, std::uint32_t block, double kick, double drift,
                QuadState<float>& state);
void move_quads(const QuadLayout<double>& layout, std::uint32_t block, double kick, double drift,
                QuadState<double>& state);

}  // namespace springlod
