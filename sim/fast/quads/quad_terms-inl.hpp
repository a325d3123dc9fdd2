// Dilatation terms of a block of quads. Included once for every vector target; see Highway's
// foreach_target.h.
#if defined(SPRINGLOD_QUAD_TERMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPRINGLOD_QUAD_TERMS_INL
#undef SPRINGLOD_QUAD_TERMS_INL
#else
#define SPRINGLOD_QUAD_TERMS_INL
#endif

#include <hwy/highway.h>

#include "sim/fast/add_product-inl.hpp"
#include "sim/fast/dilatation-inl.hpp"
#include "sim/fast/quads/quad_forces-inl.hpp"
#include "sim/fast/quads/quad_state.hpp"
#include "sim/fast/quads/quad_vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace springlod::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_MAX_BYTES >= 32

/// F and its rate of a term, by columns. A record is one vector.
HWY_INLINE void find_gradients(const QuadTerms<float>::Entry* entries, std::size_t number,
                               const NodeRecord<float>* records, GradientColumns<float>& f,
                               GradientColumns<float>& rate) {
  const D8 d;
  const D4<float> half;
  const V8 origin = hn::Load(d, record_at(records, entries[0].index).x);
  V8 first = hn::Zero(d), second = hn::Zero(d), third = hn::Zero(d);
  for (std::size_t e = 1; e < number; ++e) {
    const V8 apart = hn::Sub(hn::Load(d, record_at(records, entries[e].index).x), origin);
    first = add_product(apart, hn::Set(d, entries[e].gradient[0]), first);
    second = add_product(apart, hn::Set(d, entries[e].gradient[1]), second);
    third = add_product(apart, hn::Set(d, entries[e].gradient[2]), third);
  }
  const auto split = [&](V8 sum, int column) {
    hn::Store(hn::LowerHalf(half, sum), half, f.column[column]);
    hn::Store(hn::UpperHalf(half, sum), half, rate.column[column]);
  };
  split(first, 0);
  split(second, 1);
  split(third, 2);
}

#endif

/// The same for any vectors.
template <class Real>
HWY_INLINE void find_gradients(const typename QuadTerms<Real>::Entry* entries, std::size_t number,
                               const NodeRecord<Real>* records, GradientColumns<Real>& f,
                               GradientColumns<Real>& rate) {
  const hn::CappedTag<Real, 4> d;
  const NodeRecord<Real>& origin = record_at(records, entries[0].index);
  for (std::size_t lane = 0; lane < 4; lane += hn::Lanes(d)) {
    const auto origin_x = hn::Load(d, origin.x + lane);
    const auto origin_v = hn::Load(d, origin.v + lane);
    auto f0 = hn::Zero(d), f1 = hn::Zero(d), f2 = hn::Zero(d);
    auto r0 = hn::Zero(d), r1 = hn::Zero(d), r2 = hn::Zero(d);
    for (std::size_t e = 1; e < number; ++e) {
      const NodeRecord<Real>& record = record_at(records, entries[e].index);
      const auto x = hn::Sub(hn::Load(d, record.x + lane), origin_x);
      const auto v = hn::Sub(hn::Load(d, record.v + lane), origin_v);
      const auto b0 = hn::Set(d, entries[e].gradient[0]);
      const auto b1 = hn::Set(d, entries[e].gradient[1]);
      const auto b2 = hn::Set(d, entries[e].gradient[2]);
      f0 = add_product(x, b0, f0);
      f1 = add_product(x, b1, f1);
      f2 = add_product(x, b2, f2);
      r0 = add_product(v, b0, r0);
      r1 = add_product(v, b1, r1);
      r2 = add_product(v, b2, r2);
    }
    hn::Store(f0, d, f.column[0] + lane);
    hn::Store(f1, d, f.column[1] + lane);
    hn::Store(f2, d, f.column[2] + lane);
    hn::Store(r0, d, rate.column[0] + lane);
    hn::Store(r1, d, rate.column[1] + lane);
    hn::Store(r2, d, rate.column[2] + lane);
  }
}

/// Adds the stress times b of each node to its force.
template <class Real>
HWY_INLINE void add_stress(const typename QuadTerms<Real>::Entry* entries, std::size_t number,
                           const GradientColumns<Real>& stress, NodeVector<Real>* forces) {
  const hn::CappedTag<Real, 4> d;
  for (std::size_t lane = 0; lane < 4; lane += hn::Lanes(d)) {
    const auto s0 = hn::Load(d, stress.column[0] + lane);
    const auto s1 = hn::Load(d, stress.column[1] + lane);
    const auto s2 = hn::Load(d, stress.column[2] + lane);
    for (std::size_t e = 0; e < number; ++e) {
      Real* at = force_at(forces, entries[e].index) + lane;
      auto force = hn::Load(d, at);
      force = add_product(s0, hn::Set(d, entries[e].gradient[0]), force);
      force = add_product(s1, hn::Set(d, entries[e].gradient[1]), force);
      force = add_product(s2, hn::Set(d, entries[e].gradient[2]), force);
      hn::Store(force, d, at);
    }
  }
}

// As for springs, a term passes three stages, each in another iteration: a stage does not wait for
// the results of the one before. More slots than stages, a power of two.
constexpr std::size_t kTermSlots = 4;

template <bool with_damping, class Real>
void add_terms(const QuadTerms<Real>& terms, QuadBlockState<Real>& state) {
  const auto* const all = terms.terms.data();
  const auto* const entries = terms.entries.data();
  const NodeRecord<Real>* const records = state.records.data();
  const std::size_t count = terms.terms.size();
  GradientColumns<Real> f[kTermSlots], rate[kTermSlots];
  TermStress<Real> stress[kTermSlots];
  for (std::size_t n = 0; count > 0 && n < count + 2; ++n) {
    if (n < count)
      find_gradients(entries + all[n].first, all[n].number, records, f[n % kTermSlots],
                     rate[n % kTermSlots]);
    if (n >= 1 && n - 1 < count) {
      const std::size_t slot = (n - 1) % kTermSlots;
      find_stress<with_damping>(f[slot], rate[slot], all[n - 1].modulus, all[n - 1].damping,
                                stress[slot]);
    }
    if (n < 2) continue;
    const auto& term = all[n - 2];
    const TermStress<Real>& of_term = stress[(n - 2) % kTermSlots];
    add_stress<Real>(entries + term.first, term.number, of_term.both, state.forces.data());
    if constexpr (with_damping)
      add_stress<Real>(entries + term.first, term.number, of_term.damping,
                       state.damping_forces.data());
  }
}

}  // namespace springlod::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
