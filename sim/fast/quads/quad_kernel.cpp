#include <algorithm>
#include <limits>

#include "sim/fast/quads/quad_state.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/fast/quads/quad_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again for every target.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "sim/fast/add_product-inl.hpp"
#include "sim/fast/look/quad_look-inl.hpp"
#include "sim/fast/move-inl.hpp"
#include "sim/fast/quads/quad_copies-inl.hpp"
#include "sim/fast/quads/quad_forces-inl.hpp"
#include "sim/fast/quads/quad_terms-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace springlod::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class Real>
void find_forces(const QuadLayout<Real>& layout, std::uint32_t number, QuadState<Real>& state) {
  const QuadBlock<Real>& block = layout.blocks[number];
  QuadBlockState<Real>& own = state[number];
  copy_records(block.halo, block.own, state, own);
  prefetch_records(block, own);
  std::fill(own.forces.begin(), own.forces.end(), NodeVector<Real>{});
  std::fill(own.damping_forces.begin(), own.damping_forces.end(), NodeVector<Real>{});
  const auto damping_time = static_cast<Real>(layout.damping_time);
  if (own.damping_forces.empty()) {
    add_forces<false>(block, damping_time, own);
    add_terms<false>(block.dilatation, own);
  } else {
    add_forces<true>(block, damping_time, own);
    add_terms<true>(block.dilatation, own);
  }
}

/// Adds the forces of other blocks on their copies of this block's nodes.
template <class Real>
void collect(const QuadBlock<Real>& block,
             std::vector<NodeVector<Real>> QuadBlockState<Real>::*forces, std::uint32_t number,
             QuadState<Real>& state) {
  for (const CopiedForce& c : block.copied)
    for (int i = 0; i < 3; ++i)
      (state[number].*forces)[c.own].at[i] += (state[c.copy.block].*forces)[c.copy.index].at[i];
}

template <class Real>
double damping_power(const QuadLayout<Real>& layout, std::uint32_t number,
                     const QuadState<Real>& state) {
  const QuadBlockState<Real>& own = state[number];
  double power = 0;
  for (std::uint32_t i = 0; i < layout.blocks[number].own; ++i)
    for (int axis = 0; axis < 3; ++axis)
      power += static_cast<double>(own.damping_forces[i].at[axis]) *
               static_cast<double>(own.records[i].v[axis]);
  return power;
}

template <class Real>
using Corner = hn::CappedTag<Real, 4>;

template <bool kicks, bool drifts, class Real>
void move(const QuadBlock<Real>& block, Real kick_time, Real drift_time,
          QuadBlockState<Real>& own) {
  const Corner<Real> d;
  NodeVector<Real> least;
  NodeVector<Real> most;
  NodeVector<Real> farthest;
  for (std::size_t lane = 0; lane < 4; lane += hn::Lanes(d)) {
    auto low_corner = hn::Set(d, std::numeric_limits<Real>::max());
    auto high_corner = hn::Set(d, std::numeric_limits<Real>::lowest());
    auto far = hn::Zero(d);
    for (std::uint32_t i = 0; i < block.own; ++i) {
      NodeRecord<Real>& record = own.records[i];
      auto v = hn::Load(d, record.v + lane);
      if constexpr (kicks) {
        const auto factor = hn::Set(d, kick_time * block.inverse_mass[i]);
        v = add_product(factor, hn::Load(d, own.forces[i].at + lane), v);
        hn::Store(v, d, record.v + lane);
      }
      if constexpr (drifts) {
        const auto displacement = hn::Mul(hn::Set(d, drift_time), v);
        hn::Vec<Corner<Real>> to;
        if constexpr (kHasLow<Real>)
          to = drift(d, displacement, record.x + lane, own.low[i].at + lane);
        else
          to = drift(d, displacement, record.x + lane);
        low_corner = hn::Min(low_corner, to);
        high_corner = hn::Max(high_corner, to);
        far = hn::Max(far, hn::Abs(displacement));
      }
    }
    hn::Store(low_corner, d, least.at + lane);
    hn::Store(high_corner, d, most.at + lane);
    hn::Store(far, d, farthest.at + lane);
  }
  if (!drifts) return;
  for (int axis = 0; axis < 3; ++axis) {
    own.bounds.min()[axis] = static_cast<double>(least.at[axis]);
    own.bounds.max()[axis] = static_cast<double>(most.at[axis]);
    own.largest_displacement[axis] = static_cast<double>(farthest.at[axis]);
  }
}

template <class Real>
void move_nodes(const QuadLayout<Real>& layout, std::uint32_t number, double kick, double drift,
                QuadState<Real>& state) {
  const QuadBlock<Real>& block = layout.blocks[number];
  move_for(kick, drift, [&](auto kicks, auto drifts) {
    move<kicks, drifts>(block, static_cast<Real>(kick), static_cast<Real>(drift), state[number]);
  });
}

template <class Real>
void collect_forces(const QuadLayout<Real>& layout, std::uint32_t number, QuadState<Real>& state) {
  const QuadBlock<Real>& block = layout.blocks[number];
  collect(block, &QuadBlockState<Real>::forces, number, state);
  if (!state[number].damping_forces.empty())
    collect(block, &QuadBlockState<Real>::damping_forces, number, state);
}

template <class Real>
QuadKernels<Real> kernels() {
  return {.find_forces = find_forces<Real>,
          .collect_forces = collect_forces<Real>,
          .damping_power = damping_power<Real>,
          .move = move_nodes<Real>,
          .departure = departure<Real>,
          .find_corners = find_corners<Real>,
          .largest_strain = largest_strain<Real>};
}
QuadKernels<float> quad_kernels_float() {
  return kernels<float>();
}
QuadKernels<double> quad_kernels_double() {
  return kernels<double>();
}

}  // namespace springlod::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace springlod::sim {

HWY_EXPORT(quad_kernels_float);
HWY_EXPORT(quad_kernels_double);

template <>
QuadKernels<float> quad_kernels() {
  return HWY_DYNAMIC_DISPATCH(quad_kernels_float)();
}
template <>
QuadKernels<double> quad_kernels() {
  return HWY_DYNAMIC_DISPATCH(quad_kernels_double)();
}

}  // namespace springlod::sim
#endif
