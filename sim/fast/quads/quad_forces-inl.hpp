// Spring forces of a block of quads. Included once for every vector target; see Highway's
// foreach_target.h.
#if defined(SPRINGLOD_QUAD_FORCES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPRINGLOD_QUAD_FORCES_INL
#undef SPRINGLOD_QUAD_FORCES_INL
#else
#define SPRINGLOD_QUAD_FORCES_INL
#endif

#include <algorithm>
#include <array>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "sim/fast/add_product-inl.hpp"
#include "sim/fast/inverse_root-inl.hpp"
#include "sim/fast/quads/quad_copies-inl.hpp"
#include "sim/fast/quads/quad_state.hpp"
#include "sim/fast/quads/quad_vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace springlod::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Access by scaled index: a force has 4 numbers.
template <class Real>
HWY_INLINE Real* force_at(NodeVector<Real>* forces, std::size_t index) {
  return reinterpret_cast<Real*>(reinterpret_cast<char*>(forces) + 4 * index);
}

// A pair passes three stages: its lengths are measured, its forces follow from them, and are added
// to the nodes. Each iteration does one stage of three pairs that are this far apart [pairs]: the
// stages of an iteration do not wait for each other, so the processor overlaps the root and the
// division of one pair with the loads and stores of the others.
constexpr std::size_t kApart = 2;
constexpr std::size_t kSlots = 8;  // more than 2 kApart, a power of two
// Prefetch distance: these pairs take longer than an access to main memory. [pairs]
constexpr std::size_t kPairsAhead = 48;

/// One number for each spring of the pairs between the stages, by the number of the pair modulo
/// kSlots.
template <class Real>
using SpringNumbers = Real[kSlots][2 * kQuad];
template <class Real>
struct InFlight {
  alignas(64) SpringNumbers<Real> square;   ///< of the length [m2]
  alignas(64) SpringNumbers<Real> x_dot_v;  ///< length times its rate [m2/s]
  alignas(64) SpringNumbers<Real> both;     ///< force over length [N/m]
  alignas(64) SpringNumbers<Real> damping;  ///< the damping part of it
};

/// The pairs of a block.
template <class Real>
struct Stream {
  const QuadPair<Real>* pairs = nullptr;
  std::size_t count = 0;
  const std::array<Real, 2 * kQuad>* damping = nullptr;  // null if c = damping_time k
  Real damping_time = 0;
};

#if HWY_MAX_BYTES >= 32

HWY_INLINE void measure(const QuadPair<float>& pair, const NodeRecord<float>* records,
                        float* square, float* x_dot_v) {
  const D8 d;
  const std::uint16_t* other = pair.other;
  const V8 own0 = hn::Load(d, record_at(records, pair.own[0]).x);
  const V8 own1 = hn::Load(d, record_at(records, pair.own[1]).x);
  const auto apart = [&](std::uint16_t index, V8 own) {
    return hn::Sub(hn::Load(d, record_at(records, index).x), own);
  };
  const Side<V8> a = transpose(apart(other[0], own0), apart(other[1], own0), apart(other[2], own0),
                               apart(other[3], own0));
  const Side<V8> b = transpose(apart(other[4], own1), apart(other[5], own1), apart(other[6], own1),
                               apart(other[7], own1));
  const Side<V8> x{hn::ConcatLowerLower(d, b.x, a.x), hn::ConcatLowerLower(d, b.y, a.y),
                   hn::ConcatLowerLower(d, b.z, a.z)};
  const Side<V8> v{hn::ConcatUpperUpper(d, b.x, a.x), hn::ConcatUpperUpper(d, b.y, a.y),
                   hn::ConcatUpperUpper(d, b.z, a.z)};
  hn::Store(dot(x, x), d, square);
  hn::Store(dot(x, v), d, x_dot_v);
}
HWY_INLINE void measure(const QuadPair<double>& pair, const NodeRecord<double>* records,
                        double* square, double* x_dot_v) {
  const D4<double> d;
  for (std::size_t first = 0; first < 2 * kQuad; first += kQuad) {
    const std::uint16_t* other = pair.other + first;
    const NodeRecord<double>& own = record_at(records, pair.own[first / kQuad]);
    const V4<double> own_x = hn::Load(d, own.x);
    const V4<double> own_v = hn::Load(d, own.v);
    const auto x_apart = [&](std::uint16_t index) {
      return hn::Sub(hn::Load(d, record_at(records, index).x), own_x);
    };
    const auto v_apart = [&](std::uint16_t index) {
      return hn::Sub(hn::Load(d, record_at(records, index).v), own_v);
    };
    const Side<V4<double>> x =
        transpose(x_apart(other[0]), x_apart(other[1]), x_apart(other[2]), x_apart(other[3]));
    const Side<V4<double>> v =
        transpose(v_apart(other[0]), v_apart(other[1]), v_apart(other[2]), v_apart(other[3]));
    hn::Store(dot(x, x), d, square + first);
    hn::Store(dot(x, v), d, x_dot_v + first);
  }
}

template <class Real>
HWY_INLINE void scatter(const std::uint16_t* other, std::uint16_t own, const Real* over_length,
                        const NodeRecord<Real>* records, NodeVector<Real>* forces) {
  const D4<Real> d;
  const V4<Real> own_x = hn::Load(d, record_at(records, own).x);
  const auto take = [&](std::size_t i) {
    const V4<Real> along = hn::Sub(hn::Load(d, record_at(records, other[i]).x), own_x);
    const V4<Real> force = hn::Mul(hn::Set(d, over_length[i]), along);
    Real* at = force_at(forces, other[i]);
    hn::Store(hn::Sub(hn::Load(d, at), force), d, at);
    return force;
  };
  const Four<V4<Real>> force{take(0), take(1), take(2), take(3)};  // braces keep the order
  const V4<Real> first = hn::Add(force.first, force.second);
  const V4<Real> second = hn::Add(force.third, force.fourth);
  Real* at = force_at(forces, own);
  hn::Store(hn::Add(hn::Load(d, at), hn::Add(first, second)), d, at);
}

#else

template <class Real>
void measure(const QuadPair<Real>& pair, const NodeRecord<Real>* records, Real* square,
             Real* x_dot_v) {
  for (std::size_t s = 0; s < 2 * kQuad; ++s) {
    const NodeRecord<Real>& p = record_at(records, pair.own[s / kQuad]);
    const NodeRecord<Real>& q = record_at(records, pair.other[s]);
    Real x[3], v[3];
    for (int i = 0; i < 3; ++i) {
      x[i] = q.x[i] - p.x[i];
      v[i] = q.v[i] - p.v[i];
    }
    square[s] = dot(x, x);
    x_dot_v[s] = dot(x, v);
  }
}

template <class Real>
void scatter(const std::uint16_t* other, std::uint16_t own, const Real* over_length,
             const NodeRecord<Real>* records, NodeVector<Real>* forces) {
  const NodeRecord<Real>& p = record_at(records, own);
  for (int i = 0; i < 3; ++i) {
    Real force[kQuad];
    for (std::size_t s = 0; s < kQuad; ++s) {
      force[s] = over_length[s] * (record_at(records, other[s]).x[i] - p.x[i]);
      force_at(forces, other[s])[i] -= force[s];
    }
    force_at(forces, own)[i] += (force[0] + force[1]) + (force[2] + force[3]);
  }
}

#endif

/// Squares of lengths [m2] and l dl/dt [m2/s].
template <class Real>
HWY_INLINE void measure(const Stream<Real>& stream, std::size_t n, const NodeRecord<Real>* records,
                        InFlight<Real>& springs) {
  const QuadPair<Real>* ahead = stream.pairs + std::min(n + kPairsAhead, stream.count - 1);
  for (std::size_t byte = 0; byte < sizeof(*ahead); byte += kCacheLine)
    hwy::Prefetch(reinterpret_cast<const char*>(ahead) + byte);
  measure(stream.pairs[n], records, springs.square[n % kSlots], springs.x_dot_v[n % kSlots]);
}

/// Force / length of each spring [N/m]: total and, if requested, of the damping alone.
template <bool with_damping, class Real>
HWY_INLINE void pull(const Stream<Real>& stream, std::size_t n, InFlight<Real>& springs) {
  const hn::CappedTag<Real, 2 * kQuad> d;
  const auto beta = hn::Set(d, stream.damping_time);
  const std::size_t slot = n % kSlots;
  for (std::size_t lane = 0; lane < 2 * kQuad; lane += hn::Lanes(d)) {
    const auto inverse = inverse_root(d, hn::Load(d, springs.square[slot] + lane));
    const auto stiffness = hn::LoadU(d, stream.pairs[n].stiffness + lane);
    const auto rest_force = hn::LoadU(d, stream.pairs[n].rest_force + lane);
    const auto elastic = subtract_product(rest_force, inverse, stiffness);
    const auto rate = hn::Mul(hn::Load(d, springs.x_dot_v[slot] + lane), hn::Mul(inverse, inverse));
    const auto c = stream.damping == nullptr ? hn::Mul(beta, stiffness)
                                             : hn::LoadU(d, stream.damping[n].data() + lane);
    const auto damped = hn::Mul(c, rate);
    hn::Store(hn::Add(elastic, damped), d, springs.both[slot] + lane);
    if constexpr (with_damping) hn::Store(damped, d, springs.damping[slot] + lane);
  }
}

/// Subtracts the forces at one end and adds them at the other.
template <class Real>
HWY_INLINE void scatter(const QuadPair<Real>& pair, const Real* over_length,
                        const NodeRecord<Real>* records, NodeVector<Real>* forces) {
  for (std::size_t q = 0; q < 2; ++q)
    scatter(pair.other + q * kQuad, pair.own[q], over_length + q * kQuad, records, forces);
}

template <bool with_damping, class Real>
void add_forces(const QuadBlock<Real>& block, Real damping_time, QuadBlockState<Real>& state) {
  const NodeRecord<Real>* records = state.records.data();
  const std::size_t count = block.pairs.size();
  const Stream<Real> stream{.pairs = block.pairs.data(),
                            .count = count,
                            .damping = block.damping.empty() ? nullptr : block.damping.data(),
                            .damping_time = damping_time};
  InFlight<Real> springs;
  for (std::size_t n = 0; n < count + 2 * kApart; ++n) {
    if (n < count) measure(stream, n, records, springs);
    if (n >= kApart && n - kApart < count) pull<with_damping>(stream, n - kApart, springs);
    if (n < 2 * kApart) continue;
    const std::size_t done = n - 2 * kApart;
    scatter(stream.pairs[done], springs.both[done % kSlots], records, state.forces.data());
    if constexpr (with_damping)
      scatter(stream.pairs[done], springs.damping[done % kSlots], records,
              state.damping_forces.data());
  }
}

}  // namespace springlod::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
