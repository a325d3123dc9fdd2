// The law of a dilatation term. Included once for every vector target; see Highway's
// foreach_target.h.
#if defined(SPRINGLOD_DILATATION_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPRINGLOD_DILATATION_INL
#undef SPRINGLOD_DILATATION_INL
#else
#define SPRINGLOD_DILATATION_INL
#endif

#include <cmath>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace springlod::sim::HWY_NAMESPACE {

/// A 3 x 3 matrix by columns, padded.
template <class Real>
struct GradientColumns {
  alignas(4 * sizeof(Real)) Real column[3][4] = {};
};

/// Force on a node over its b: -T (eps + beta d eps/dt) d eps/dF [J], and the damping part of it.
template <class Real>
struct TermStress {
  GradientColumns<Real> both, damping;
};

template <class Real>
HWY_INLINE void cross(const Real (&p)[4], const Real (&q)[4], Real (&to)[4]) {
  to[0] = p[1] * q[2] - p[2] * q[1];
  to[1] = p[2] * q[0] - p[0] * q[2];
  to[2] = p[0] * q[1] - p[1] * q[0];
}

template <class Real>
HWY_INLINE Real dot(const Real (&p)[4], const Real (&q)[4]) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

/// See model/dilatation.hpp: F, its rate, T and beta T of one term.
template <bool with_damping, class Real>
HWY_INLINE void find_stress(const GradientColumns<Real>& f, const GradientColumns<Real>& rate,
                            Real modulus, Real damping, TermStress<Real>& stress) {
  GradientColumns<Real> by_f;  // of J
  cross(f.column[1], f.column[2], by_f.column[0]);
  cross(f.column[2], f.column[0], by_f.column[1]);
  cross(f.column[0], f.column[1], by_f.column[2]);
  const Real change = dot(f.column[0], by_f.column[0]) - 1;
  const Real volume_rate = dot(rate.column[0], by_f.column[0]) +
                           dot(rate.column[1], by_f.column[1]) +
                           dot(rate.column[2], by_f.column[2]);
  const Real bounded = modulus > 0 ? Real(1) : 1 / std::sqrt(1 + change * change);
  const Real slope = bounded * bounded * bounded;
  const Real damped = damping * slope * volume_rate;
  const Real both = -slope * (modulus * change * bounded + damped);
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) {
      stress.both.column[k][i] = both * by_f.column[k][i];
      if constexpr (with_damping) stress.damping.column[k][i] = -slope * damped * by_f.column[k][i];
    }
}

}  // namespace springlod::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
