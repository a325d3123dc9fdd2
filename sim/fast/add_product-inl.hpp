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

// Rounded twice, unlike hn::MulAdd where the processor has a fused multiply-add: the same bits on
// every processor. Kernels wait for memory, roots and divisions, so that this costs little.

/// p q + sum
template <class V>
HWY_INLINE V add_product(V p, V q, V sum) {
  return hwy::HWY_NAMESPACE::Add(sum, hwy::HWY_NAMESPACE::Mul(p, q));
}
/// sum - p q
template <class V>
HWY_INLINE V subtract_product(V p, V q, V sum) {
  return hwy::HWY_NAMESPACE::Sub(sum, hwy::HWY_NAMESPACE::Mul(p, q));
}

}  // namespace springlod::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
