#include <limits>

#include "sim/fast/rows/row_state.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/fast/rows/row_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again for every target.
#include <hwy/highway.h>

#include "sim/fast/add_product-inl.hpp"
#include "sim/fast/inverse_root-inl.hpp"
#include "sim/fast/look/row_look-inl.hpp"
#include "sim/fast/move-inl.hpp"
#include "sim/fast/rows/row_terms-inl.hpp"
#include "sim/fast/rows/row_vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace springlod::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

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
  clear<Real>(block, state.force[number]);
  if (with_damping) clear<Real>(block, state.damping_force[number]);
  const Starts<Real> x = starts_of<Real>(state.x, block.first);
  const Starts<Real> v = starts_of<Real>(state.v, block.first);
  const Starts<Real> force = starts_of<Real>(state.force[number]);
  const Starts<Real> damping_force =
      with_damping ? starts_of<Real>(state.damping_force[number]) : force;
  const SpringRow* const rows = layout.rows.data();
  const std::uint32_t* const first_row = layout.first_row.data() + block.first / kRowLanes;
  const RowProperties<Real>* const all_properties = layout.properties.data();
  constexpr std::uint32_t kParts = kRowParts<Real>;
  const auto each_part = [&](const auto& act) {
    for (std::uint32_t part = 0; part < kParts; ++part) act(part, part * lane_count<Real>());
  };
  for (std::uint32_t p = 0; p < block.places(); p += kRowLanes) {
    const SpringRow* const end = rows + first_row[p / kRowLanes + 1];
    Vector3<D> own_x[kParts], own_v[kParts], own_force[kParts], own_damping[kParts];
    each_part([&](std::uint32_t part, std::uint32_t lane) {
      own_x[part] = load(d, x, p + lane);
      own_v[part] = load(d, v, p + lane);
      own_force[part] = own_damping[part] = none;
    });
    for (const SpringRow* row = rows + first_row[p / kRowLanes]; row != end; ++row) {
      const RowProperties<Real>& properties = all_properties[row->properties];
      each_part([&](std::uint32_t part, std::uint32_t lane) {
        const std::uint32_t other = p + lane + row->ahead;
        const Vector3<D> along = load(d, x, other) - own_x[part];
        const Vector3<D> apart = load(d, v, other) - own_v[part];
        const hn::Vec<D> inverse = inverse_root(d, dot<D>(along, along));
        const hn::Vec<D> rate = hn::Mul(dot<D>(along, apart), hn::Mul(inverse, inverse));
        // Force / length.
        const hn::Vec<D> elastic =
            subtract_product(hn::LoadU(d, properties.rest_force + lane), inverse,
                             hn::LoadU(d, properties.stiffness + lane));
        const hn::Vec<D> damping = hn::Mul(hn::LoadU(d, properties.damping + lane), rate);
        const hn::Vec<D> both = hn::Add(elastic, damping);
        own_force[part] = add_scaled<D>(own_force[part], both, along);
        store(d, subtract_scaled<D>(load(d, force, other), both, along), force, other);
        if constexpr (with_damping) {
          own_damping[part] = add_scaled<D>(own_damping[part], damping, along);
          store(d, subtract_scaled<D>(load(d, damping_force, other), damping, along), damping_force,
                other);
        }
      });
    }
    each_part([&](std::uint32_t part, std::uint32_t lane) {
      const std::uint32_t own = p + lane;
      store(d, load(d, force, own) + own_force[part], force, own);
      if constexpr (with_damping)
        store(d, load(d, damping_force, own) + own_damping[part], damping_force, own);
    });
  }
}

/// Adds the forces of earlier blocks on the places of this block.
template <class Real>
void collect(const RowLayout<Real>& layout, std::uint32_t number,
             std::vector<typename RowState<Real>::Coordinates>& force) {
  const Lanes<Real> d;
  const RowBlock& block = layout.blocks[number];
  const Starts<Real> to = starts_of<Real>(force[number]);
  for (std::uint32_t earlier = layout.first_contributor(number); earlier < number; ++earlier) {
    const RowBlock& by = layout.blocks[earlier];
    const std::uint32_t offset = block.first - by.first;
    const std::uint32_t size = by.places() + by.reach;
    if (size <= offset) continue;
    const std::uint32_t count = std::min(block.places(), size - offset);
    const Starts<Real> from = starts_of<Real>(force[earlier], offset);
    for (std::uint32_t p = 0; p < count; p += lane_count<Real>())
      store(d, load(d, to, p) + load(d, from, p), to, p);
  }
}

template <class Real>
double damping_power(const RowLayout<Real>& layout, std::uint32_t number,
                     const RowState<Real>& state) {
  using D = Lanes<Real>;
  const D d;
  const RowBlock& block = layout.blocks[number];
  const Starts<Real> force = starts_of<Real>(state.damping_force[number]);
  const Starts<Real> v = starts_of<Real>(state.v, block.first);
  double power = 0;
  for (std::uint32_t p = 0; p < block.places(); p += kRowLanes) {
    alignas(64) Real of[kRowLanes];
    for (std::uint32_t lane = 0; lane < kRowLanes; lane += lane_count<Real>())
      hn::Store(dot<D>(load(d, force, p + lane), load(d, v, p + lane)), d, of + lane);
    const auto sum = [&](std::size_t i) {
      return static_cast<double>(of[i]) + static_cast<double>(of[i + 1]);
    };
    power += (sum(0) + sum(2)) + (sum(4) + sum(6));
  }
  return power;
}

template <bool kicks, bool drifts, class Real>
void move_axis(const RowLayout<Real>& layout, std::uint32_t number, Real kick_time, Real drift_time,
               std::size_t axis, RowState<Real>& state) {
  const Lanes<Real> d;
  const RowBlock& block = layout.blocks[number];
  const Real* HWY_RESTRICT inverse_mass = layout.inverse_mass.data() + block.first;
  const Real* HWY_RESTRICT force = state.force[number][axis].get();
  Real* HWY_RESTRICT all_v = state.v[axis].get() + block.first;
  Real* HWY_RESTRICT all_x = state.x[axis].get() + block.first;
  auto least = hn::Set(d, std::numeric_limits<Real>::max());
  auto most = hn::Set(d, std::numeric_limits<Real>::lowest());
  auto farthest = hn::Zero(d);
  for (std::uint32_t p = 0; p < block.places(); p += lane_count<Real>()) {
    auto v = hn::LoadU(d, all_v + p);
    if constexpr (kicks) {
      const auto factor = hn::Mul(hn::Set(d, kick_time), hn::LoadU(d, inverse_mass + p));
      v = add_product(factor, hn::LoadU(d, force + p), v);
      hn::StoreU(v, d, all_v + p);
    }
    if constexpr (drifts) {
      const auto displacement = hn::Mul(hn::Set(d, drift_time), v);
      hn::Vec<Lanes<Real>> to;
      if constexpr (kHasLow<Real>)
        to = drift(d, displacement, all_x + p, state.low[axis].get() + block.first + p);
      else
        to = drift(d, displacement, all_x + p);
      least = hn::Min(least, to);
      most = hn::Max(most, to);
      farthest = hn::Max(farthest, hn::Abs(displacement));
    }
  }
  if (!drifts) return;
  const auto i = static_cast<Eigen::Index>(axis);
  Box3& bounds = state.bounds[number];
  bounds.min()[i] = static_cast<double>(hn::GetLane(hn::MinOfLanes(d, least)));
  bounds.max()[i] = static_cast<double>(hn::GetLane(hn::MaxOfLanes(d, most)));
  state.largest_displacement[number][i] =
      static_cast<double>(hn::GetLane(hn::MaxOfLanes(d, farthest)));
}

template <class Real>
void move(const RowLayout<Real>& layout, std::uint32_t number, double kick, double drift,
          RowState<Real>& state) {
  move_for(kick, drift, [&](auto kicks, auto drifts) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      move_axis<kicks, drifts>(layout, number, static_cast<Real>(kick), static_cast<Real>(drift),
                               axis, state);
  });
}

template <class Real>
void find_all_forces(const RowLayout<Real>& layout, std::uint32_t block, RowState<Real>& state) {
  if (state.damping_force.empty()) {
    find_forces<false>(layout, block, state);
    add_terms<false>(layout, block, state);
  } else {
    find_forces<true>(layout, block, state);
    add_terms<true>(layout, block, state);
  }
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
          .departure = departure<Real>,
          .find_corners = find_corners<Real>,
          .largest_strain = largest_strain<Real>};
}
RowKernels<float> row_kernels_float() {
  return kernels<float>();
}
RowKernels<double> row_kernels_double() {
  return kernels<double>();
}

}  // namespace springlod::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace springlod::sim {

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

}  // namespace springlod::sim
#endif
