// Vectors of consecutive places. Included once for every vector target; see Highway's
// foreach_target.h.
#if defined(SPRINGLOD_ROW_VECTORS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPRINGLOD_ROW_VECTORS_INL
#undef SPRINGLOD_ROW_VECTORS_INL
#else
#define SPRINGLOD_ROW_VECTORS_INL
#endif

#include <array>

#include <hwy/highway.h>

#include "sim/fast/add_product-inl.hpp"
#include "sim/fast/rows/row_state.hpp"

HWY_BEFORE_NAMESPACE();
namespace springlod::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class Real>
using Lanes = hn::CappedTag<Real, kRowLanes>;

/// Vectors in the kRowLanes places of a row. Whatever their number, kernels add the forces on a
/// place in the same order, row by row.
template <class Real>
inline constexpr std::uint32_t kRowParts = kRowLanes /
                                           static_cast<std::uint32_t>(hn::MaxLanes(Lanes<Real>()));

template <class D>
struct Vector3 {
  hn::Vec<D> x, y, z;
};

/// Start of each coordinate array, kept in registers: the compiler must assume that any store may
/// change what a RowState refers to.
template <class Real>
struct Starts {
  Real* x;
  Real* y;
  Real* z;
};
template <class Real>
HWY_INLINE Starts<Real> starts_of(const std::array<hwy::AlignedFreeUniquePtr<Real[]>, 3>& of,
                                  std::size_t first = 0) {
  return {of[0].get() + first, of[1].get() + first, of[2].get() + first};
}

template <class D>
HWY_INLINE Vector3<D> load(D d, const Starts<hn::TFromD<D>>& from, std::size_t place) {
  return {hn::LoadU(d, from.x + place), hn::LoadU(d, from.y + place), hn::LoadU(d, from.z + place)};
}
template <class D>
HWY_INLINE void store(D d, const Vector3<D>& v, const Starts<hn::TFromD<D>>& to,
                      std::size_t place) {
  hn::StoreU(v.x, d, to.x + place);
  hn::StoreU(v.y, d, to.y + place);
  hn::StoreU(v.z, d, to.z + place);
}
template <class D>
HWY_INLINE Vector3<D> operator-(const Vector3<D>& p, const Vector3<D>& q) {
  return {hn::Sub(p.x, q.x), hn::Sub(p.y, q.y), hn::Sub(p.z, q.z)};
}
template <class D>
HWY_INLINE Vector3<D> operator+(const Vector3<D>& p, const Vector3<D>& q) {
  return {hn::Add(p.x, q.x), hn::Add(p.y, q.y), hn::Add(p.z, q.z)};
}
/// p + factor q
template <class D>
HWY_INLINE Vector3<D> add_scaled(const Vector3<D>& p, hn::Vec<D> factor, const Vector3<D>& q) {
  return {add_product(factor, q.x, p.x), add_product(factor, q.y, p.y),
          add_product(factor, q.z, p.z)};
}
/// p - factor q
template <class D>
HWY_INLINE Vector3<D> subtract_scaled(const Vector3<D>& p, hn::Vec<D> factor, const Vector3<D>& q) {
  return {subtract_product(factor, q.x, p.x), subtract_product(factor, q.y, p.y),
          subtract_product(factor, q.z, p.z)};
}
template <class D>
HWY_INLINE hn::Vec<D> dot(const Vector3<D>& p, const Vector3<D>& q) {
  return add_product(p.x, q.x, add_product(p.y, q.y, hn::Mul(p.z, q.z)));
}

template <class D>
HWY_INLINE Vector3<D> cross(const Vector3<D>& p, const Vector3<D>& q) {
  return {subtract_product(p.z, q.y, hn::Mul(p.y, q.z)),
          subtract_product(p.x, q.z, hn::Mul(p.z, q.x)),
          subtract_product(p.y, q.x, hn::Mul(p.x, q.y))};
}

template <class Real>
std::uint32_t lane_count() {
  return static_cast<std::uint32_t>(hn::Lanes(Lanes<Real>()));
}

}  // namespace springlod::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
