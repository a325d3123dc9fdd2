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
  std::vector<NodeVector<Real>> forces;          ///< [N]
  std::vector<NodeVector<Real>> damping_forces;  ///< the part of them that is damping; may be empty
  /// What x of own nodes is too coarse to hold [m]: a step's way is often less than the last bit of
  /// a place. Empty in double precision.
  std::vector<NodeVector<Real>> low;
  Box3 bounds;  ///< of the own nodes [m]
};

template <class Real>
using QuadState = std::vector<QuadBlockState<Real>>;

/// Copies the halo of a block and works out its springs: k (l - L) + c dl/dt along each, into the
/// forces of both ends.
template <class Real>
void find_quad_forces(const QuadLayout<Real>& layout, std::uint32_t block, QuadState<Real>& state);
/// Adds what other blocks worked out on their copies of this one's nodes to its own.
template <class Real>
void collect_quad_forces(const QuadLayout<Real>& layout, std::uint32_t block,
                         QuadState<Real>& state);
/// Sum of damping force times velocity over the nodes of the block [W], once collected.
template <class Real>
double quad_damping_power(const QuadLayout<Real>& layout, std::uint32_t block,
                          const QuadState<Real>& state);
/// v += kick f / m, then x += drift v for the block's nodes, and their bounds; with 0 seconds of
/// either, that part is left out.
template <class Real>
void move_quads(const QuadLayout<Real>& layout, std::uint32_t block, double kick, double drift,
                QuadState<Real>& state);

/// Appends the indices of the block's own nodes that lie within the region, rising.
template <class Real>
void find_quad_nodes(const QuadLayout<Real>& layout, std::uint32_t block,
                     const QuadState<Real>& state, const Box3& region,
                     std::vector<std::uint32_t>& indices);

}  // namespace springlod
