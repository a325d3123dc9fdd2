#include <limits>

#include "sim/fast/row_state.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/fast/row_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again for every target.
#include <hwy/highway.h>

#include "sim/fast/inverse_root-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace springlod::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class Real>
using Lanes = hn::CappedTag<Real, kRowLanes>;

template <class D>
struct Vector3 {
  hn::Vec<D> x, y, z;
};

template <class D, class Real>
HWY_INLINE Vector3<D> load(D d, const typename RowState<Real>::Coordinates& from,
                           std::size_t place) {
  return {hn::LoadU(d, from[0].get() + place), hn::LoadU(d, from[1].get() + place),
          hn::LoadU(d, from[2].get() + place)};
}
template <class D, class Real>
HWY_INLINE void store(D d, const Vector3<D>& v, typename RowState<Real>::Coordinates& to,
                      std::size_t place) {
  hn::StoreU(v.x, d, to[0].get() + place);
  hn::StoreU(v.y, d, to[1].get() + place);
  hn::StoreU(v.z, d, to[2].get() + place);
}
template <class D>
HWY_INLINE Vector3<D> operator-(const Vector3<D>& p, const Vector3<D>& q) {
  return {hn::Sub(p.x, q.x), hn::Sub(p.y, q.y), hn::Sub(p.z, q.z)};
}
template <class D>
HWY_INLINE hn::Vec<D> dot(const Vector3<D>& p, const Vector3<D>& q) {
  return hn::MulAdd(p.x, q.x, hn::MulAdd(p.y, q.y, hn::Mul(p.z, q.z)));
}

template <class Real>
void find_forces(const RowLayout<Real>& layout, std::uint32_t number, RowState<Real>& state) {
  const Lanes<Real> d;
  using D = Lanes<Real>;
  const RowBlock& block = layout.blocks[number];
  auto& force = state.force[number];
  for (auto& array : force)
    std::fill_n(array.get(), block.places() + block.reach, Real(0));
  for (std::uint32_t p = 0; p < block.places(); p += kRowLanes) {
    const std::uint32_t eight = (block.first + p) / kRowLanes;
    const SpringRow* const end = layout.rows.data() + layout.first_row[eight + 1];
    for (std::uint32_t lane = 0; lane < kRowLanes; lane += static_cast<std::uint32_t>(hn::Lanes(d))) {
      const std::uint32_t place = block.first + p + lane;
      const Vector3<D> own_x = load<D, Real>(d, state.x, place);
      const Vector3<D> own_v = load<D, Real>(d, state.v, place);
      Vector3<D> own_force{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
      for (const SpringRow* row = layout.rows.data() + layout.first_row[eight]; row != end; ++row) {
        const RowProperties<Real>& properties = layout.properties[row->properties];
        const Vector3<D> along = load<D, Real>(d, state.x, place + row->ahead) - own_x;
        const Vector3<D> apart = load<D, Real>(d, state.v, place + row->ahead) - own_v;
        const hn::Vec<D> square = dot<D>(along, along);
        const hn::Vec<D> inverse = inverse_root(d, square);
        const hn::Vec<D> rate = hn::Mul(dot<D>(along, apart), hn::Mul(inverse, inverse));
        const hn::Vec<D> scale =
            hn::MulAdd(hn::LoadU(d, properties.damping + lane), rate,
                       hn::NegMulAdd(hn::LoadU(d, properties.rest_force + lane), inverse,
                                     hn::LoadU(d, properties.stiffness + lane)));
        own_force = {hn::MulAdd(scale, along.x, own_force.x),
                     hn::MulAdd(scale, along.y, own_force.y),
                     hn::MulAdd(scale, along.z, own_force.z)};
        const std::size_t other = p + lane + row->ahead;
        Vector3<D> other_force = load<D, Real>(d, force, other);
        other_force = {hn::NegMulAdd(scale, along.x, other_force.x),
                       hn::NegMulAdd(scale, along.y, other_force.y),
                       hn::NegMulAdd(scale, along.z, other_force.z)};
        store<D, Real>(d, other_force, force, other);
      }
      const Vector3<D> so_far = load<D, Real>(d, force, p + lane);
      store<D, Real>(d,
                     {hn::Add(so_far.x, own_force.x), hn::Add(so_far.y, own_force.y),
                      hn::Add(so_far.z, own_force.z)},
                     force, p + lane);
    }
  }
}

/// What earlier blocks worked out on this one's places, added to its own.
template <class Real>
void collect(const RowLayout<Real>& layout, std::uint32_t number, RowState<Real>& state) {
  const Lanes<Real> d;
  using D = Lanes<Real>;
  const RowBlock& block = layout.blocks[number];
  for (std::uint32_t from = layout.first_contributor(number); from < number; ++from) {
    const RowBlock& earlier = layout.blocks[from];
    const std::uint32_t offset = block.first - earlier.first;
    const std::uint32_t size = earlier.places() + earlier.reach;
    if (size <= offset) continue;
    const std::uint32_t count = std::min(block.places(), size - offset);
    for (std::uint32_t p = 0; p < count; p += static_cast<std::uint32_t>(hn::Lanes(d))) {
      const Vector3<D> mine = load<D, Real>(d, state.force[number], p);
      const Vector3<D> more = load<D, Real>(d, state.force[from], offset + p);
      store<D, Real>(
          d, {hn::Add(mine.x, more.x), hn::Add(mine.y, more.y), hn::Add(mine.z, more.z)},
          state.force[number], p);
    }
  }
}

template <class Real>
void move(const RowLayout<Real>& layout, std::uint32_t number, double kick, double drift,
          RowState<Real>& state) {
  const Lanes<Real> d;
  collect(layout, number, state);
  const RowBlock& block = layout.blocks[number];
  const auto kick_time = hn::Set(d, static_cast<Real>(kick));
  const auto drift_time = hn::Set(d, static_cast<Real>(drift));
  const auto step = static_cast<std::uint32_t>(hn::Lanes(d));
  for (int axis = 0; axis < 3; ++axis) {
    Real* HWY_RESTRICT x = state.x[axis].get() + block.first;
    Real* HWY_RESTRICT v = state.v[axis].get() + block.first;
    const Real* HWY_RESTRICT f = state.force[number][axis].get();
    const Real* HWY_RESTRICT inverse_mass = layout.inverse_mass.data() + block.first;
    auto least = hn::Set(d, std::numeric_limits<Real>::max());
    auto most = hn::Set(d, std::numeric_limits<Real>::lowest());
    for (std::uint32_t p = 0; p < block.places(); p += step) {
      const auto factor = hn::Mul(kick_time, hn::LoadU(d, inverse_mass + p));
      const auto speed = hn::MulAdd(factor, hn::LoadU(d, f + p), hn::LoadU(d, v + p));
      hn::StoreU(speed, d, v + p);
      const auto from = hn::LoadU(d, x + p);
      auto to = hn::MulAdd(drift_time, speed, from);
      if constexpr (sizeof(Real) == sizeof(float)) {
        Real* HWY_RESTRICT low = state.low[axis].get() + block.first;
        const auto way = hn::MulAdd(drift_time, speed, hn::LoadU(d, low + p));
        to = hn::Add(from, way);
        hn::StoreU(hn::Sub(way, hn::Sub(to, from)), d, low + p);
      }
      hn::StoreU(to, d, x + p);
      least = hn::Min(least, to);
      most = hn::Max(most, to);
    }
    state.bounds[number].min()[axis] = static_cast<double>(hn::GetLane(hn::MinOfLanes(d, least)));
    state.bounds[number].max()[axis] = static_cast<double>(hn::GetLane(hn::MaxOfLanes(d, most)));
  }
}

void find_forces_float(const RowLayout<float>& layout, std::uint32_t block,
                       RowState<float>& state) {
  find_forces(layout, block, state);
}
void find_forces_double(const RowLayout<double>& layout, std::uint32_t block,
                        RowState<double>& state) {
  find_forces(layout, block, state);
}
void move_float(const RowLayout<float>& layout, std::uint32_t block, double kick, double drift,
                RowState<float>& state) {
  move(layout, block, kick, drift, state);
}
void move_double(const RowLayout<double>& layout, std::uint32_t block, double kick, double drift,
                 RowState<double>& state) {
  move(layout, block, kick, drift, state);
}

}  // namespace springlod::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace springlod {

HWY_EXPORT(find_forces_float);
HWY_EXPORT(find_forces_double);
HWY_EXPORT(move_float);
HWY_EXPORT(move_double);

void find_row_forces(const RowLayout<float>& layout, std::uint32_t block, RowState<float>& state) {
  HWY_DYNAMIC_DISPATCH(find_forces_float)(layout, block, state);
}
void find_row_forces(const RowLayout<double>& layout, std::uint32_t block,
                     RowState<double>& state) {
  HWY_DYNAMIC_DISPATCH(find_forces_double)(layout, block, state);
}
void move_rows(const RowLayout<float>& layout, std::uint32_t block, double kick, double drift,
               RowState<float>& state) {
  HWY_DYNAMIC_DISPATCH(move_float)(layout, block, kick, drift, state);
}
void move_rows(const RowLayout<double>& layout, std::uint32_t block, double kick, double drift,
               RowState<double>& state) {
  HWY_DYNAMIC_DISPATCH(move_double)(layout, block, kick, drift, state);
}

}  // namespace springlod
#endif
