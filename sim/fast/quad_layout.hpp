#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/fast/place.hpp"

namespace springlod::sim {

/// Springs worked out side by side, all at one node.
inline constexpr std::uint32_t kQuad = 4;

/// Two quads; what one step needs of eight springs, in one stream through memory.
template <class Real>
struct QuadPair {
  // Indices in the block, times kIndexScale: so they are addresses without arithmetic.
  std::uint16_t own[2] = {};            ///< own end of each quad
  std::uint16_t other[2 * kQuad] = {};  ///< other ends
  Real stiffness[2 * kQuad] = {};       ///< k [N/m]
  Real rest_force[2 * kQuad] = {};      ///< k L [N]
};
template <class Real>
inline constexpr std::uint32_t kIndexScale = sizeof(Real);

/// The force on the copy of a node in another block: it belongs to the node itself.
struct CopiedForce {
  std::uint32_t own = 0;  ///< index of the node in its block
  Place copy;
};

/// Neighbouring nodes and the springs that this block works out: four to a *quad*, all of them at
/// one own node, their other ends own nodes or copies of those of other blocks (the *halo*).
///
/// Indices within a block: own nodes, then the halo, then one that nothing touches, for the springs
/// without stiffness that fill a quad up.
template <class Real>
struct QuadBlock {
  std::uint32_t own = 0;            ///< nodes
  std::vector<std::uint32_t> node;  ///< the own ones in the model
  std::vector<Real> inverse_mass;   ///< of own nodes [1/kg]
  std::vector<Place> halo;          ///< where the copies are from

  std::vector<QuadPair<Real>> pairs;
  std::vector<std::array<Real, 2 * kQuad>> damping;  ///< c [N s/m] by pair; empty if damping_time k

  std::vector<CopiedForce> copied;  ///< own nodes rising
  // All blocks with copies of its nodes, and itself, are from the first to the last of these.
  std::uint32_t first_copy = 0;
  std::uint32_t last_copy = 0;

  std::uint32_t nowhere() const { return own + static_cast<std::uint32_t>(halo.size()); }
};

/// A model of any shape laid out for fast steps. Every spring is worked out once, by one of its
/// ends, chosen so that hardly a quad has a gap. Which block does what depends on the model alone,
/// never on the number of threads, and neither does the order of any sum.
template <class Real>
struct QuadLayout {
  std::vector<QuadBlock<Real>> blocks;
  std::vector<Place> place;  ///< of each node; N
  /// c / k of every spring, where they all have the same [s].
  double damping_time = 0;
};

/// Throws InputError for a node with more than some 8000 springs.
template <class Real>
QuadLayout<Real> make_quad_layout(const MassSpringModel& model);

}  // namespace springlod::sim
