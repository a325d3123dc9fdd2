// Included once for every vector target; see Highway's foreach_target.h.
#if defined(SPRINGLOD_MOVE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPRINGLOD_MOVE_INL
#undef SPRINGLOD_MOVE_INL
#else
#define SPRINGLOD_MOVE_INL
#endif

#include <type_traits>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace springlod::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// x += displacement. Returns the new x.
template <class D>
HWY_INLINE hn::Vec<D> drift(D d, hn::Vec<D> displacement, hn::TFromD<D>* HWY_RESTRICT x) {
  const hn::Vec<D> to = hn::Add(hn::LoadU(d, x), displacement);
  hn::StoreU(to, d, x);
  return to;
}

/// The same with compensated summation (Kahan): `low` holds the part below the last bit of x.
template <class D>
HWY_INLINE hn::Vec<D> drift(D d, hn::Vec<D> displacement, hn::TFromD<D>* HWY_RESTRICT x,
                            hn::TFromD<D>* HWY_RESTRICT low) {
  const hn::Vec<D> from = hn::LoadU(d, x);
  const hn::Vec<D> whole = hn::Add(displacement, hn::LoadU(d, low));
  const hn::Vec<D> to = hn::Add(from, whole);
  hn::StoreU(hn::Sub(whole, hn::Sub(to, from)), d, low);
  hn::StoreU(to, d, x);
  return to;
}

/// Whether positions are kept in two parts.
template <class Real>
inline constexpr bool kHasLow = sizeof(Real) == sizeof(float);

/// Calls move(kicks, drifts) with std::bool_constant: whether kick and drift differ from 0. Does
/// nothing if both are 0.
template <class Move>
HWY_INLINE void move_for(double kick, double drift, const Move& move) {
  if (kick != 0 && drift != 0)
    move(std::true_type(), std::true_type());
  else if (kick != 0)
    move(std::true_type(), std::false_type());
  else if (drift != 0)
    move(std::false_type(), std::true_type());
}

}  // namespace springlod::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
