// Included once for every vector target; see Highway's foreach_target.h.
#if defined(SPRINGLOD_INVERSE_ROOT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPRINGLOD_INVERSE_ROOT_INL
#undef SPRINGLOD_INVERSE_ROOT_INL
#else
#define SPRINGLOD_INVERSE_ROOT_INL
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace springlod::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Squared lengths [m2] are clamped to this value, so that the force of a spring of zero length is
// 0, not infinite. Its square root, 1e-15 m, is below any length of interest, and its inverse is
// finite in both precisions.
inline constexpr float kShortestSquare = 1e-30F;

/// 1 / sqrt(square), within one or two units in the last place in single precision (an estimate and
/// a Halley step) and one in double. A Newton step would leave an error of 3/2 of the square of the
/// estimate's error, always of the same sign. With the coarse estimates of some processors (4e-4),
/// this acts as a prestress of 1e-7 of all springs, which is visible in the bending of slender
/// bodies.
template <class D>
HWY_INLINE hn::Vec<D> inverse_root(D d, hn::Vec<D> square) {
  using Real = hn::TFromD<D>;
  const hn::Vec<D> s = hn::Max(square, hn::Set(d, static_cast<Real>(kShortestSquare)));
  if constexpr (sizeof(Real) == sizeof(float)) {
    const hn::Vec<D> r = hn::ApproximateReciprocalSqrt(s);
    const hn::Vec<D> residual = hn::NegMulAdd(hn::Mul(s, r), r, hn::Set(d, 1.0F));
    const hn::Vec<D> part = hn::MulAdd(hn::Set(d, 0.375F), residual, hn::Set(d, 0.5F));
    return hn::MulAdd(hn::Mul(r, residual), part, r);
  } else {
    return hn::Div(hn::Set(d, 1.0), hn::Sqrt(s));
  }
}

}  // namespace springlod::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
