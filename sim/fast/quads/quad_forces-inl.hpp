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

// Pairs computed together, each stage for all of them [1]. A processor looks ahead about 300
// instructions, less than three pairs: if pairs were computed one after another, each would wait
// for the results of the one before.
constexpr std::size_t kBatch = 16;
// Prefetch distance: 3 batches take longer than an access to main memory. [pairs]
constexpr std::size_t kPairsAhead = 3 * kBatch;

/// One number for each spring of a batch.
template <class Real>
struct SpringNumbers {
  alignas(64) Real of[kBatch][2 * kQuad];
};

/// Data shared by all pairs of a batch.
template <class Real>
struct Batch {
  const QuadPair<Real>* pairs = nullptr;
  std::size_t count = 0;
  std::size_t ahead = 0;                                 // pairs to prefetch
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
  const V4<Real> first = hn::Add(take(0), take(1));
  const V4<Real> second = hn::Add(take(2), take(3));
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
    square[s] = 0;
    x_dot_v[s] = 0;
    for (int i = 0; i < 3; ++i) {
      square[s] += (q.x[i] - p.x[i]) * (q.x[i] - p.x[i]);
      x_dot_v[s] += (q.x[i] - p.x[i]) * (q.v[i] - p.v[i]);
    }
  }
}

template <class Real>
void scatter(const std::uint16_t* other, std::uint16_t own, const Real* over_length,
             const NodeRecord<Real>* records, NodeVector<Real>* forces) {
  const NodeRecord<Real>& p = record_at(records, own);
  for (std::size_t s = 0; s < kQuad; ++s) {
    const NodeRecord<Real>& q = record_at(records, other[s]);
    for (int i = 0; i < 3; ++i) {
      const Real force = over_length[s] * (q.x[i] - p.x[i]);
      force_at(forces, own)[i] += force;
      force_at(forces, other[s])[i] -= force;
    }
  }
}

#endif

/// Squares of lengths [m2] and l dl/dt [m2/s].
template <class Real>
HWY_INLINE void measure(const Batch<Real>& batch, const NodeRecord<Real>* records,
                        SpringNumbers<Real>& square, SpringNumbers<Real>& x_dot_v) {
  for (std::size_t n = 0; n < batch.count; ++n) {
    const QuadPair<Real>* pair = batch.pairs + n;
    for (std::size_t byte = 0; byte < sizeof(*pair); byte += kCacheLine)
      hwy::Prefetch(reinterpret_cast<const char*>(pair + batch.ahead) + byte);
    measure(*pair, records, square.of[n], x_dot_v.of[n]);
  }
}

/// Force / length of each spring [N/m]: total and, if requested, of the damping alone.
template <bool with_damping, class Real>
HWY_INLINE void pull(const Batch<Real>& batch, const SpringNumbers<Real>& square,
                     const SpringNumbers<Real>& x_dot_v, SpringNumbers<Real>& both,
                     SpringNumbers<Real>& damping) {
  const hn::CappedTag<Real, 2 * kQuad> d;
  const auto beta = hn::Set(d, batch.damping_time);
  for (std::size_t n = 0; n < batch.count; ++n)
    for (std::size_t lane = 0; lane < 2 * kQuad; lane += hn::Lanes(d)) {
      const auto inverse = inverse_root(d, hn::Load(d, square.of[n] + lane));
      const auto stiffness = hn::LoadU(d, batch.pairs[n].stiffness + lane);
      const auto rest_force = hn::LoadU(d, batch.pairs[n].rest_force + lane);
      const auto elastic = hn::NegMulAdd(rest_force, inverse, stiffness);
      const auto rate = hn::Mul(hn::Load(d, x_dot_v.of[n] + lane), hn::Mul(inverse, inverse));
      const auto c = batch.damping == nullptr ? hn::Mul(beta, stiffness)
                                              : hn::LoadU(d, batch.damping[n].data() + lane);
      const auto damped = hn::Mul(c, rate);
      hn::Store(hn::Add(elastic, damped), d, both.of[n] + lane);
      if constexpr (with_damping) hn::Store(damped, d, damping.of[n] + lane);
    }
}

/// Subtracts the forces at one end and adds them at the other.
template <class Real>
HWY_INLINE void scatter(const Batch<Real>& batch, const SpringNumbers<Real>& over_length,
                        const NodeRecord<Real>* records, NodeVector<Real>* forces) {
  for (std::size_t n = 0; n < batch.count; ++n)
    for (std::size_t q = 0; q < 2; ++q)
      scatter(batch.pairs[n].other + q * kQuad, batch.pairs[n].own[q],
              over_length.of[n] + q * kQuad, records, forces);
}

template <bool with_damping, class Real>
void add_forces(const QuadBlock<Real>& block, Real damping_time, QuadBlockState<Real>& state) {
  const NodeRecord<Real>* records = state.records.data();
  SpringNumbers<Real> square;
  SpringNumbers<Real> x_dot_v;
  SpringNumbers<Real> both;
  SpringNumbers<Real> damping;
  for (std::size_t first = 0; first < block.pairs.size(); first += kBatch) {
    const std::size_t left = block.pairs.size() - first;
    const std::size_t count = std::min(kBatch, left);
    const Batch<Real> batch{.pairs = block.pairs.data() + first,
                            .count = count,
                            .ahead = std::min(kPairsAhead, left - count),
                            .damping = block.damping.empty() ? nullptr : &block.damping[first],
                            .damping_time = damping_time};
    measure(batch, records, square, x_dot_v);
    pull<with_damping>(batch, square, x_dot_v, both, damping);
    scatter(batch, both, records, state.forces.data());
    if constexpr (with_damping) scatter(batch, damping, records, state.damping_forces.data());
  }
}

}  // namespace springlod::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
