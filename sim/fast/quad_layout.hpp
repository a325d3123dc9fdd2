#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/fast/place.hpp"

namespace springlod {

/// What a step needs of one node, in one load: 32 bytes (float) or 64 (double).
template <class Real>
struct alignas(8 * sizeof(Real)) NodeRecord {
  Real x[3] = {};         ///< [m]
  Real inverse_mass = 0;  ///< [1/kg]
  Real v[3] = {};         ///< [m/s]
  Real contact_area = 0;  ///< [m2]
};

template <class Real>
struct alignas(4 * sizeof(Real)) NodeForce {
  Real f[4] = {};  ///< [N]; the last is not used
};

/// Neighbouring nodes and the springs that this block works out: four to a *quad*, all of them at
/// one own node, their other ends own nodes or copies of those of other blocks (the *halo*).
///
/// records and forces: own nodes, then the halo, then one that nothing touches, for the springs
/// without stiffness that fill a quad up.
template <class Real>
struct SpringBlock {
  std::uint32_t own = 0;          ///< nodes
  std::vector<Place> halo;  ///< where the copies are from
  std::vector<NodeRecord<Real>> records;
  std::vector<NodeForce<Real>> forces;

  std::vector<std::uint16_t> quad_node;  ///< own end of each quad; an even number of quads
  std::vector<std::uint16_t> other_end;  ///< place of the other end, 4 a quad
  std::vector<Real> stiffness;           ///< k [N/m], 4 a quad
  std::vector<Real> rest_force;          ///< k L [N], 4 a quad
  std::vector<Real> damping;             ///< c [N s/m], 4 a quad

  /// Copies of own node i in other blocks, whose forces are its own too: entries copies_first[i] to
  /// copies_first[i + 1] of copies.
  std::vector<std::uint32_t> copies_first;
  std::vector<Place> copies;
};

/// A model laid out for fast steps. Every spring is worked out once, by one of its ends, chosen so
/// that hardly a quad has a gap. Which block does what depends on the model alone, never on the
/// number of threads, and neither does the order of any sum.
template <class Real>
struct SpringBlocks {
  std::vector<SpringBlock<Real>> blocks;
  std::vector<Place> place;  ///< of each node of the model, N
};

/// At rest; see set_state. Throws InputError for an invalid model.
template <class Real>
SpringBlocks<Real> make_spring_blocks(const MassSpringModel& model);

/// Places and velocities into the records of own nodes.
template <class Real>
void set_state(SpringBlocks<Real>& blocks, const State& state);
/// Out of them; the time is left as it is.
template <class Real>
void get_state(const SpringBlocks<Real>& blocks, State& state);

}  // namespace springlod
