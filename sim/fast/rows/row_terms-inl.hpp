// Dilatation terms of a block of rows. Included once for every vector target; see Highway's
// foreach_target.h.
#if defined(SPRINGLOD_ROW_TERMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPRINGLOD_ROW_TERMS_INL
#undef SPRINGLOD_ROW_TERMS_INL
#else
#define SPRINGLOD_ROW_TERMS_INL
#endif

#include <hwy/highway.h>

#include "sim/fast/add_product-inl.hpp"
#include "sim/fast/rows/row_state.hpp"
#include "sim/fast/rows/row_vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace springlod::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A 3 x 3 matrix of each lane, by columns.
template <class D>
struct Columns {
  Vector3<D> first, second, third;
};

/// The columns of the sum, over the nodes, of the vector of each node times its b^T.
template <class D, class Real>
HWY_INLINE Columns<D> gradient_of(D d, const Starts<Real>& of, std::uint32_t place,
                                  const TermRow& row, const TermShape<Real>& shape) {
  const Vector3<D> none{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  Columns<D> sum{none, none, none};
  const Vector3<D> origin = load(d, of, place);
  for (std::uint32_t c = 1; c < kCellNodes; ++c) {
    const Vector3<D> apart = load(d, of, place + row.ahead[c]) - origin;
    sum.first = add_scaled<D>(sum.first, hn::Set(d, shape.gradient[c][0]), apart);
    sum.second = add_scaled<D>(sum.second, hn::Set(d, shape.gradient[c][1]), apart);
    sum.third = add_scaled<D>(sum.third, hn::Set(d, shape.gradient[c][2]), apart);
  }
  return sum;
}

template <class D>
HWY_INLINE Columns<D> scaled(hn::Vec<D> scale, const Columns<D>& columns) {
  const auto times = [&](const Vector3<D>& v) {
    return Vector3<D>{hn::Mul(scale, v.x), hn::Mul(scale, v.y), hn::Mul(scale, v.z)};
  };
  return {times(columns.first), times(columns.second), times(columns.third)};
}

/// Adds the stress of each part of the row, times b of each node, to the force of the node.
template <class D, class Real>
HWY_INLINE void add_stress(D d, const Columns<D> (&stress)[kRowParts<Real>], std::uint32_t place,
                           const TermRow& row, const TermShape<Real>& shape,
                           const Starts<Real>& force) {
  // Neighbouring nodes of a line write to overlapping places: executed one right after another,
  // each would wait for the store of the previous one.
  for (std::uint32_t first = 0; first < 2; ++first)
    for (std::uint32_t c = first; c < kCellNodes; c += 2)
      for (std::uint32_t part = 0; part < kRowParts<Real>; ++part) {
        const std::uint32_t at = place + part * lane_count<Real>() + row.ahead[c];
        Vector3<D> sum = load(d, force, at);
        sum = add_scaled<D>(sum, hn::Set(d, shape.gradient[c][0]), stress[part].first);
        sum = add_scaled<D>(sum, hn::Set(d, shape.gradient[c][1]), stress[part].second);
        sum = add_scaled<D>(sum, hn::Set(d, shape.gradient[c][2]), stress[part].third);
        store(d, sum, force, at);
      }
}

/// See find_stress of dilatation-inl.hpp.
template <bool with_damping, class Real>
void add_terms(const RowLayout<Real>& layout, std::uint32_t number, RowState<Real>& state) {
  using D = Lanes<Real>;
  const D d;
  const RowTerms<Real>& terms = layout.dilatation;
  if (terms.first_row.empty()) return;
  const RowBlock& block = layout.blocks[number];
  const Starts<Real> x = starts_of<Real>(state.x, block.first);
  const Starts<Real> v = starts_of<Real>(state.v, block.first);
  const Starts<Real> force = starts_of<Real>(state.force[number]);
  const Starts<Real> damping_force =
      with_damping ? starts_of<Real>(state.damping_force[number]) : force;
  const std::uint32_t* const first_row = terms.first_row.data() + block.first / kRowLanes;
  const auto one = hn::Set(d, Real(1));
  for (std::uint32_t p = 0; p < block.places(); p += kRowLanes) {
    for (std::uint32_t r = first_row[p / kRowLanes]; r < first_row[p / kRowLanes + 1]; ++r) {
      const TermRow& row = terms.rows[r];
      const TermShape<Real>& shape = terms.shapes[row.shape];
      Columns<D> both[kRowParts<Real>], by_damping[kRowParts<Real>];
      for (std::uint32_t part = 0; part < kRowParts<Real>; ++part) {
        const std::uint32_t lane = part * lane_count<Real>();
        const auto modulus = hn::LoadU(d, terms.properties[row.properties].modulus + lane);
        const auto damping = hn::LoadU(d, terms.properties[row.properties].damping + lane);
        const Columns<D> f = gradient_of(d, x, p + lane, row, shape);
        const Columns<D> rate = gradient_of(d, v, p + lane, row, shape);
        const Columns<D> by_f{cross<D>(f.second, f.third), cross<D>(f.third, f.first),
                              cross<D>(f.first, f.second)};
        const auto change = hn::Sub(dot<D>(f.first, by_f.first), one);
        const auto volume_rate =
            hn::Add(hn::Add(dot<D>(rate.first, by_f.first), dot<D>(rate.second, by_f.second)),
                    dot<D>(rate.third, by_f.third));
        auto bounded = one;
        const auto negative = hn::Lt(modulus, hn::Zero(d));
        if (!hn::AllFalse(d, negative))
          bounded = hn::IfThenElse(negative,
                                   hn::Div(one, hn::Sqrt(add_product(change, change, one))), one);
        const auto slope = hn::Mul(bounded, hn::Mul(bounded, bounded));
        const auto damped = hn::Mul(damping, hn::Mul(slope, volume_rate));
        const auto strained = add_product(modulus, hn::Mul(change, bounded), damped);
        both[part] = scaled<D>(hn::Neg(hn::Mul(slope, strained)), by_f);
        if constexpr (with_damping)
          by_damping[part] = scaled<D>(hn::Neg(hn::Mul(slope, damped)), by_f);
      }
      add_stress(d, both, p, row, shape, force);
      if constexpr (with_damping) add_stress(d, by_damping, p, row, shape, damping_force);
    }
  }
}

}  // namespace springlod::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
