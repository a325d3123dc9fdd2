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

/// 1 / sqrt(square), rounded twice, with the same bits on every processor. The processors'
/// estimates of it have different bits, and kernels wait longer for memory than for this.
template <class D>
HWY_INLINE hn::Vec<D> inverse_root(D d, hn::Vec<D> square) {
  using Real = hn::TFromD<D>;
  const hn::Vec<D> s = hn::Max(square, hn::Set(d, static_cast<Real>(kShortestSquare)));
  return hn::Div(hn::Set(d, Real(1)), hn::Sqrt(s));
}

}  // namespace springlod::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
