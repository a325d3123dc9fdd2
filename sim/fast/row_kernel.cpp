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
HWY_INLINE Vector3<D> operator+(const Vector3<D>& p, const Vector3<D>& q) {
  return {hn::Add(p.x, q.x), hn::Add(p.y, q.y), hn::Add(p.z, q.z)};
}
/// p + factor q
template <class D>
HWY_INLINE Vector3<D> add_scaled(const Vector3<D>& p, hn::Vec<D> factor, const Vector3<D>& q) {
  return {hn::MulAdd(factor, q.x, p.x), hn::MulAdd(factor, q.y, p.y), hn::MulAdd(factor, q.z, p.z)};
}
/// p - factor q
template <class D>
HWY_INLINE Vector3<D> subtract_scaled(const Vector3<D>& p, hn::Vec<D> factor, const Vector3<D>& q) {
  return {hn::NegMulAdd(factor, q.x, p.x), hn::NegMulAdd(factor, q.y, p.y),
          hn::NegMulAdd(factor, q.z, p.z)};
}
template <class D>
HWY_INLINE hn::Vec<D> dot(const Vector3<D>& p, const Vector3<D>& q) {
  return hn::MulAdd(p.x, q.x, hn::MulAdd(p.y, q.y, hn::Mul(p.z, q.z)));
}

template <class Real>
std::uint32_t lane_count() {
  return static_cast<std::uint32_t>(hn::Lanes(Lanes<Real>()));
}

template <class Real>
void clear(const RowBlock& block, typename RowState<Real>::Coordinates& force) {
  for (auto& array : force) std::fill_n(array.get(), block.places() + block.reach, Real(0));
}

template <bool with_damping, class Real>
void find_forces(const RowLayout<Real>& layout, std::uint32_t number, RowState<Real>& state) {
  using D = Lanes<Real>;
  const D d;
  const Vector3<D> none{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  const RowBlock& block = layout.blocks[number];
  auto& force = state.force[number];
  auto& damping_force = with_damping ? state.damping_force[number] : force;
  clear<Real>(block, force);
  if (with_damping) clear<Real>(block, damping_force);
  for (std::uint32_t p = 0; p < block.places(); p += lane_count<Real>()) {
    const std::uint32_t place = block.first + p;
    const std::uint32_t lane = place % kRowLanes;
    const SpringRow* row = layout.rows.data() + layout.first_row[place / kRowLanes];
    const SpringRow* const end = layout.rows.data() + layout.first_row[place / kRowLanes + 1];
    const Vector3<D> own_x = load<D, Real>(d, state.x, place);
    const Vector3<D> own_v = load<D, Real>(d, state.v, place);
    Vector3<D> own_force = none;
    Vector3<D> own_damping = none;
    for (; row != end; ++row) {
      const RowProperties<Real>& properties = layout.properties[row->properties];
      const Vector3<D> along = load<D, Real>(d, state.x, place + row->ahead) - own_x;
      const Vector3<D> apart = load<D, Real>(d, state.v, place + row->ahead) - own_v;
      const hn::Vec<D> inverse = inverse_root(d, dot<D>(along, along));
      const hn::Vec<D> rate = hn::Mul(dot<D>(along, apart), hn::Mul(inverse, inverse));
      // Forces over length.
      const hn::Vec<D> elastic = hn::NegMulAdd(hn::LoadU(d, properties.rest_force + lane), inverse,
                                               hn::LoadU(d, properties.stiffness + lane));
      const hn::Vec<D> damping = hn::Mul(hn::LoadU(d, properties.damping + lane), rate);
      const hn::Vec<D> both = hn::Add(elastic, damping);
      own_force = add_scaled<D>(own_force, both, along);
      const std::uint32_t other = p + row->ahead;
      store<D, Real>(d, subtract_scaled<D>(load<D, Real>(d, force, other), both, along), force,
                     other);
      if constexpr (with_damping) {
        own_damping = add_scaled<D>(own_damping, damping, along);
        store<D, Real>(d,
                       subtract_scaled<D>(load<D, Real>(d, damping_force, other), damping, along),
                       damping_force, other);
      }
    }
    store<D, Real>(d, load<D, Real>(d, force, p) + own_force, force, p);
    if constexpr (with_damping)
      store<D, Real>(d, load<D, Real>(d, damping_force, p) + own_damping, damping_force, p);
  }
}

/// What earlier blocks worked out on the places of this one.
template <class Real>
void collect(const RowLayout<Real>& layout, std::uint32_t number,
             std::vector<typename RowState<Real>::Coordinates>& force) {
  using D = Lanes<Real>;
  const D d;
  const RowBlock& block = layout.blocks[number];
  for (std::uint32_t from = layout.first_contributor(number); from < number; ++from) {
    const RowBlock& earlier = layout.blocks[from];
    const std::uint32_t offset = block.first - earlier.first;
    const std::uint32_t size = earlier.places() + earlier.reach;
    if (size <= offset) continue;
    const std::uint32_t count = std::min(block.places(), size - offset);
    for (std::uint32_t p = 0; p < count; p += lane_count<Real>())
      store<D, Real>(d,
                     load<D, Real>(d, force[number], p) + load<D, Real>(d, force[from], offset + p),
                     force[number], p);
  }
}

template <class Real>
double damping_power(const RowLayout<Real>& layout, std::uint32_t number,
                     const RowState<Real>& state) {
  using D = Lanes<Real>;
  const D d;
  const RowBlock& block = layout.blocks[number];
  double power = 0;
  for (std::uint32_t p = 0; p < block.places(); p += lane_count<Real>())
    power += static_cast<double>(
        hn::GetLane(hn::SumOfLanes(d, dot<D>(load<D, Real>(d, state.damping_force[number], p),
                                             load<D, Real>(d, state.v, block.first + p)))));
  return power;
}

template <class Real>
void find_nodes(const RowLayout<Real>& layout, std::uint32_t number, const RowState<Real>& state,
                const Box3& region, std::vector<std::uint32_t>& indices) {
  using D = Lanes<Real>;
  const D d;
  const RowBlock& block = layout.blocks[number];
  const auto set = [&](double value) { return hn::Set(d, static_cast<Real>(value)); };
  const Vector3<D> low{set(region.min().x()), set(region.min().y()), set(region.min().z())};
  const Vector3<D> high{set(region.max().x()), set(region.max().y()), set(region.max().z())};
  const auto within = [](auto value, auto least, auto most) {
    return hn::And(hn::Ge(value, least), hn::Le(value, most));
  };
  for (std::uint32_t p = 0; p < block.own; p += lane_count<Real>()) {
    const Vector3<D> x = load<D, Real>(d, state.x, block.first + p);
    const auto inside = hn::And(hn::And(within(x.x, low.x, high.x), within(x.y, low.y, high.y)),
                                within(x.z, low.z, high.z));
    if (hn::AllFalse(d, inside)) continue;
    std::uint8_t bits[8] = {};  // a bit a lane; Highway writes 8 bytes at least
    hn::StoreMaskBits(d, inside, bits);
    for (std::uint32_t lane = 0; lane < lane_count<Real>() && p + lane < block.own; ++lane)
      if ((bits[0] >> lane & 1U) != 0) indices.push_back(p + lane);
  }
}

template <class Real>
void kick_axis(const RowLayout<Real>& layout, const RowBlock& block, Real time,
               const Real* HWY_RESTRICT force, Real* HWY_RESTRICT v) {
  const Lanes<Real> d;
  const Real* HWY_RESTRICT inverse_mass = layout.inverse_mass.data() + block.first;
  for (std::uint32_t p = 0; p < block.places(); p += lane_count<Real>()) {
    const auto factor = hn::Mul(hn::Set(d, time), hn::LoadU(d, inverse_mass + p));
    hn::StoreU(hn::MulAdd(factor, hn::LoadU(d, force + p), hn::LoadU(d, v + p)), d, v + p);
  }
}

template <class Real>
void drift_axis(const RowBlock& block, Real time, std::size_t axis, RowState<Real>& state,
                Box3& bounds) {
  const Lanes<Real> d;
  Real* HWY_RESTRICT x = state.x[axis].get() + block.first;
  const Real* HWY_RESTRICT v = state.v[axis].get() + block.first;
  auto least = hn::Set(d, std::numeric_limits<Real>::max());
  auto most = hn::Set(d, std::numeric_limits<Real>::lowest());
  for (std::uint32_t p = 0; p < block.places(); p += lane_count<Real>()) {
    const auto way = hn::Mul(hn::Set(d, time), hn::LoadU(d, v + p));
    const auto from = hn::LoadU(d, x + p);
    auto to = hn::Add(from, way);
    if constexpr (sizeof(Real) == sizeof(float)) {
      Real* HWY_RESTRICT low = state.low[axis].get() + block.first + p;
      const auto whole = hn::Add(way, hn::LoadU(d, low));
      to = hn::Add(from, whole);
      hn::StoreU(hn::Sub(whole, hn::Sub(to, from)), d, low);
    }
    hn::StoreU(to, d, x + p);
    least = hn::Min(least, to);
    most = hn::Max(most, to);
  }
  const auto i = static_cast<Eigen::Index>(axis);
  bounds.min()[i] = static_cast<double>(hn::GetLane(hn::MinOfLanes(d, least)));
  bounds.max()[i] = static_cast<double>(hn::GetLane(hn::MaxOfLanes(d, most)));
}

template <class Real>
void move(const RowLayout<Real>& layout, std::uint32_t number, double kick, double drift,
          RowState<Real>& state) {
  const RowBlock& block = layout.blocks[number];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (kick != 0)
      kick_axis(layout, block, static_cast<Real>(kick), state.force[number][axis].get(),
                state.v[axis].get() + block.first);
    if (drift != 0) drift_axis(block, static_cast<Real>(drift), axis, state, state.bounds[number]);
  }
}

template <class Real>
void find_all_forces(const RowLayout<Real>& layout, std::uint32_t block, RowState<Real>& state) {
  if (state.damping_force.empty())
    find_forces<false>(layout, block, state);
  else
    find_forces<true>(layout, block, state);
}

template <class Real>
void collect_forces(const RowLayout<Real>& layout, std::uint32_t block, RowState<Real>& state) {
  collect(layout, block, state.force);
  if (!state.damping_force.empty()) collect(layout, block, state.damping_force);
}

template <class Real>
RowKernels<Real> kernels() {
  return {.find_forces = find_all_forces<Real>,
          .collect_forces = collect_forces<Real>,
          .damping_power = damping_power<Real>,
          .move = move<Real>,
          .find_nodes = find_nodes<Real>};
}
RowKernels<float> row_kernels_float() {
  return kernels<float>();
}
RowKernels<double> row_kernels_double() {
  return kernels<double>();
}

}  // namespace springlod::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace springlod {

HWY_EXPORT(row_kernels_float);
HWY_EXPORT(row_kernels_double);

template <>
RowKernels<float> row_kernels() {
  return HWY_DYNAMIC_DISPATCH(row_kernels_float)();
}
template <>
RowKernels<double> row_kernels() {
  return HWY_DYNAMIC_DISPATCH(row_kernels_double)();
}

}  // namespace springlod
#endif
