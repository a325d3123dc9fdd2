#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/fast/place.hpp"

namespace springlod::sim {

/// Springs in one vector operation; all share one node.
inline constexpr std::size_t kQuad = 4;

/// Two quads: the data of eight springs that a step reads, as one stream through memory.
template <class Real>
struct QuadPair {
  // Indices in the block times kIndexScale, which makes them addresses without arithmetic.
  std::uint16_t own[2] = {};            ///< own end of each quad
  std::uint16_t other[2 * kQuad] = {};  ///< other ends
  Real stiffness[2 * kQuad] = {};       ///< k [N/m]
  Real rest_force[2 * kQuad] = {};      ///< k L [N]
};
template <class Real>
inline constexpr std::uint32_t kIndexScale = sizeof(Real);

/// The force on a node's copy in another block, to be added to the node itself.
struct CopiedForce {
  std::uint32_t own = 0;  ///< index of the node in its block
  Place copy;
};

/// Eight corners of a block. Those that pad it are missing (see MarginTerms).
template <class Real>
struct CornerEight {
  std::uint16_t node[4][2 * kQuad] = {};  ///< indices in the block, not scaled
  Real scale[2 * kQuad] = {};             ///< [1/m2]
  Real offset[2 * kQuad] = {};            ///< [m]
};

/// Dilatation terms of a block, as one stream through memory.
template <class Real>
struct QuadTerms {
  struct Term {
    Real modulus = 0;                     ///< T [J]
    Real damping = 0;                     ///< beta T [J s]
    std::uint32_t first = 0, number = 0;  ///< entries
  };
  struct Entry {
    Real gradient[3] = {};    ///< b [1/m]
    std::uint32_t index = 0;  ///< of the node in the block, scaled as in QuadPair
  };
  std::vector<Term> terms;
  std::vector<Entry> entries;
};

/// Neighbouring nodes and the springs that this block computes. The four springs of a *quad* share
/// an own node; their other ends are own nodes or copies of other blocks' nodes (the *halo*).
///
/// Indices within a block: own nodes, then the halo, then an unused one for the springs without
/// stiffness that pad a quad, then copies of further nodes of the corners.
template <class Real>
struct QuadBlock {
  std::uint32_t own = 0;            ///< nodes
  std::vector<std::uint32_t> node;  ///< number in the model of each own node
  std::vector<Real> inverse_mass;   ///< of own nodes [1/kg]
  std::vector<Place> halo;          ///< original of each copy

  std::vector<QuadPair<Real>> pairs;
  std::vector<std::array<Real, 2 * kQuad>> damping;  ///< c [N s/m] by pair; empty if damping_time k

  QuadTerms<Real> dilatation;  ///< those whose middle entry is an own node

  std::vector<CornerEight<Real>> corners;    ///< those whose node[0] is an own node
  std::vector<std::uint32_t> corner_number;  ///< in the model, by corner; or kNoCorner
  std::vector<Place> corner_halo;            ///< originals of the nodes that only corners need

  std::vector<CopiedForce> copied;  ///< own nodes ascending
  // Range of blocks that contains this block and all blocks with copies of its nodes.
  std::uint32_t first_copy = 0;
  std::uint32_t last_copy = 0;

  std::uint32_t nowhere() const { return own + static_cast<std::uint32_t>(halo.size()); }
  std::uint32_t indices() const {
    return nowhere() + 1 + static_cast<std::uint32_t>(corner_halo.size());
  }
};

/// A model of any shape laid out for fast steps. Each spring is computed once, at one of its ends,
/// which is chosen so that few quads have gaps. The blocks and the order of all sums depend only on
/// the model, not on the number of threads.
template <class Real>
struct QuadLayout {
  std::vector<QuadBlock<Real>> blocks;
  std::vector<Place> place;  ///< place of each node; N
  /// c / k if all springs have the same, else 0 [s].
  double damping_time = 0;
};

/// Throws InputError for a node with more than about 8000 springs.
template <class Real>
QuadLayout<Real> make_quad_layout(const MassSpringModel& model);

}  // namespace springlod::sim
