// Vectors of nodes of a block of quads. Included once for every vector target; see Highway's
// foreach_target.h.
#if defined(SPRINGLOD_QUAD_VECTORS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPRINGLOD_QUAD_VECTORS_INL
#undef SPRINGLOD_QUAD_VECTORS_INL
#else
#define SPRINGLOD_QUAD_VECTORS_INL
#endif

#include <hwy/highway.h>

#include "sim/fast/add_product-inl.hpp"
#include "sim/fast/quads/quad_state.hpp"

HWY_BEFORE_NAMESPACE();
namespace springlod::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Access by scaled index: a record has 8 numbers.
template <class Real>
HWY_INLINE const NodeRecord<Real>& record_at(const NodeRecord<Real>* records, std::size_t index) {
  return *reinterpret_cast<const NodeRecord<Real>*>(reinterpret_cast<const char*>(records) +
                                                    8 * index);
}
#if HWY_MAX_BYTES >= 32

template <class Real>
using D4 = hn::FixedTag<Real, 4>;
template <class Real>
using V4 = hn::Vec<D4<Real>>;
using D8 = hn::FixedTag<float, 8>;
using V8 = hn::Vec<D8>;

/// Four 3D vectors, one SIMD vector per coordinate.
template <class V>
struct Side {
  V x, y, z;
};

/// Four records of position (lower half) and velocity (upper half), transposed.
HWY_INLINE Side<V8> transpose(V8 a, V8 b, V8 c, V8 e) {
  const D8 d;
  const hn::Repartition<double, D8> wide;
  const auto join_lower = [&](V8 p, V8 q) {
    return hn::BitCast(d, hn::InterleaveLower(wide, hn::BitCast(wide, p), hn::BitCast(wide, q)));
  };
  const auto join_upper = [&](V8 p, V8 q) {
    return hn::BitCast(d, hn::InterleaveUpper(wide, hn::BitCast(wide, p), hn::BitCast(wide, q)));
  };
  const V8 ab_xy = hn::InterleaveLower(d, a, b);
  const V8 ab_zw = hn::InterleaveUpper(d, a, b);
  const V8 ce_xy = hn::InterleaveLower(d, c, e);
  const V8 ce_zw = hn::InterleaveUpper(d, c, e);
  return {join_lower(ab_xy, ce_xy), join_upper(ab_xy, ce_xy), join_lower(ab_zw, ce_zw)};
}
/// Four records x y z 0, transposed.
HWY_INLINE Side<V4<double>> transpose(V4<double> a, V4<double> b, V4<double> c, V4<double> e) {
  const D4<double> d;
  const V4<double> ab_x_z = hn::InterleaveLower(d, a, b);
  const V4<double> ab_y_w = hn::InterleaveUpper(d, a, b);
  const V4<double> ce_x_z = hn::InterleaveLower(d, c, e);
  const V4<double> ce_y_w = hn::InterleaveUpper(d, c, e);
  return {hn::ConcatLowerLower(d, ce_x_z, ab_x_z), hn::ConcatLowerLower(d, ce_y_w, ab_y_w),
          hn::ConcatUpperUpper(d, ce_x_z, ab_x_z)};
}
template <class V>
HWY_INLINE V dot(const Side<V>& p, const Side<V>& q) {
  return add_product(p.x, q.x, add_product(p.y, q.y, hn::Mul(p.z, q.z)));
}

/// Vectors to four nodes (double) or eight (float): those of the first four in the lower halves.
template <class V>
struct Four {
  V first, second, third, fourth;
};
template <class V>
HWY_INLINE Four<V> operator-(const Four<V>& p, const Four<V>& q) {
  return {hn::Sub(p.first, q.first), hn::Sub(p.second, q.second), hn::Sub(p.third, q.third),
          hn::Sub(p.fourth, q.fourth)};
}
template <class V>
HWY_INLINE Side<V> transpose(const Four<V>& four) {
  return transpose(four.first, four.second, four.third, four.fourth);
}

/// The positions of the records record(0), record(1), ...
template <class Record>
HWY_INLINE Four<V8> positions(float, const Record& record) {
  const auto load = [&](std::size_t i) {
    const D4<float> half;
    return hn::Combine(D8(), hn::Load(half, record(i + 4).x), hn::Load(half, record(i).x));
  };
  return {load(0), load(1), load(2), load(3)};
}
template <class Record>
HWY_INLINE Four<V4<double>> positions(double, const Record& record) {
  const auto load = [&](std::size_t i) { return hn::Load(D4<double>(), record(i).x); };
  return {load(0), load(1), load(2), load(3)};
}

#else

/// Sums in the order of dot() of vectors.
template <class Real>
HWY_INLINE Real dot(const Real (&p)[3], const Real (&q)[3]) {
  return p[0] * q[0] + (p[1] * q[1] + p[2] * q[2]);
}

#endif

/// Nodes that positions() loads.
template <class Real>
inline constexpr std::size_t kTogether = 32 / sizeof(Real);

}  // namespace springlod::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
