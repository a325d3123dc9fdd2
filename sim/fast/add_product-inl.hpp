// Products added to a vector. Included once for every vector target; see Highway's
// foreach_target.h.
#if defined(SPRINGLOD_ADD_PRODUCT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPRINGLOD_ADD_PRODUCT_INL
#undef SPRINGLOD_ADD_PRODUCT_INL
#else
#define SPRINGLOD_ADD_PRODUCT_INL
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace springlod::sim::HWY_NAMESPACE {

// Whether products are rounded before they are added is all by which the bits of two targets
// differ. Without it, rows of springs take up to 16 % longer. Builds for tests do without, so that
// all targets can be held against each other.
#if HWY_NATIVE_FMA && !defined(SPRINGLOD_UNFUSED)
inline constexpr bool kFuses = true;
#else
inline constexpr bool kFuses = false;
#endif

/// p q + sum
template <class V>
HWY_INLINE V add_product(V p, V q, V sum) {
  if constexpr (kFuses) return hwy::HWY_NAMESPACE::MulAdd(p, q, sum);
  return hwy::HWY_NAMESPACE::Add(sum, hwy::HWY_NAMESPACE::Mul(p, q));
}
/// sum - p q
template <class V>
HWY_INLINE V subtract_product(V p, V q, V sum) {
  if constexpr (kFuses) return hwy::HWY_NAMESPACE::NegMulAdd(p, q, sum);
  return hwy::HWY_NAMESPACE::Sub(sum, hwy::HWY_NAMESPACE::Mul(p, q));
}

}  // namespace springlod::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
