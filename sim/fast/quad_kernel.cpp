#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/fast/quad_state.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/fast/quad_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again for every target.
#include <hwy/highway.h>

#include "sim/fast/inverse_root-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace springlod::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// By scaled index: 8 numbers a record, 4 a force.
template <class Real>
HWY_INLINE const NodeRecord<Real>& record_at(const NodeRecord<Real>* records, std::size_t index) {
  return *reinterpret_cast<const NodeRecord<Real>*>(reinterpret_cast<const char*>(records) +
                                                    8 * index);
}
template <class Real>
HWY_INLINE Real* force_at(NodeVector<Real>* forces, std::size_t index) {
  return reinterpret_cast<Real*>(reinterpret_cast<char*>(forces) + 4 * index);
}

/// Springs of a block without vectors.
template <bool with_damping, class Real>
void add_forces_plainly(const QuadBlock<Real>& block, Real damping_time,
                        QuadBlockState<Real>& state) {
  for (std::size_t n = 0; n < block.pairs.size(); ++n) {
    const QuadPair<Real>& pair = block.pairs[n];
    for (std::uint32_t s = 0; s < 2 * kQuad; ++s) {
      const std::uint16_t a = pair.own[s / kQuad];
      const std::uint16_t b = pair.other[s];
      const NodeRecord<Real>& p = record_at(state.records.data(), a);
      const NodeRecord<Real>& q = record_at(state.records.data(), b);
      const Real x[3] = {q.x[0] - p.x[0], q.x[1] - p.x[1], q.x[2] - p.x[2]};
      const Real square =
          std::max(x[0] * x[0] + x[1] * x[1] + x[2] * x[2], static_cast<Real>(kShortestSquare));
      const Real way =
          x[0] * (q.v[0] - p.v[0]) + x[1] * (q.v[1] - p.v[1]) + x[2] * (q.v[2] - p.v[2]);
      const Real elastic = pair.stiffness[s] - pair.rest_force[s] / std::sqrt(square);
      const Real c = block.damping.empty() ? damping_time * pair.stiffness[s] : block.damping[n][s];
      const Real damping = c * way / square;
      for (int i = 0; i < 3; ++i) {
        force_at(state.forces.data(), a)[i] += (elastic + damping) * x[i];
        force_at(state.forces.data(), b)[i] -= (elastic + damping) * x[i];
        if constexpr (with_damping) {
          force_at(state.damping_forces.data(), a)[i] += damping * x[i];
          force_at(state.damping_forces.data(), b)[i] -= damping * x[i];
        }
      }
    }
  }
}

/// Differences of records with their coordinates side by side.
template <class V>
struct Side {
  V x, y, z;
};

#if HWY_MAX_BYTES >= 32

using F8 = hn::FixedTag<float, 8>;
using F4 = hn::FixedTag<float, 4>;
using D4 = hn::FixedTag<double, 4>;
using V8 = hn::Vec<F8>;
using V4 = hn::Vec<F4>;
using W4 = hn::Vec<D4>;

/// Four records of places (lower half) and velocities (upper half) each, turned.
HWY_INLINE Side<V8> transpose(V8 a, V8 b, V8 c, V8 e) {
  const F8 d;
  const hn::Repartition<double, F8> wide;
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
/// Four of x y z 0, turned.
HWY_INLINE Side<W4> transpose(W4 a, W4 b, W4 c, W4 e) {
  const D4 d;
  const W4 ab_x_z = hn::InterleaveLower(d, a, b);
  const W4 ab_y_w = hn::InterleaveUpper(d, a, b);
  const W4 ce_x_z = hn::InterleaveLower(d, c, e);
  const W4 ce_y_w = hn::InterleaveUpper(d, c, e);
  return {hn::ConcatLowerLower(d, ce_x_z, ab_x_z), hn::ConcatLowerLower(d, ce_y_w, ab_y_w),
          hn::ConcatUpperUpper(d, ce_x_z, ab_x_z)};
}

/// Forces over length of springs whose ends differ by x and v.
template <class V>
struct Pull {
  V both, damping;
};
template <class D, class Real, class V>
HWY_INLINE Pull<V> pull(D d, const Side<V>& x, const Side<V>& v, const Real* all_stiffness,
                        const Real* all_rest_force, const Real* all_damping, V damping_time) {
  const V square = hn::MulAdd(x.x, x.x, hn::MulAdd(x.y, x.y, hn::Mul(x.z, x.z)));
  const V way = hn::MulAdd(x.x, v.x, hn::MulAdd(x.y, v.y, hn::Mul(x.z, v.z)));  // l dl/dt
  const V inverse = inverse_root(d, square);
  const V stiffness = hn::LoadU(d, all_stiffness);
  const V elastic = hn::NegMulAdd(hn::LoadU(d, all_rest_force), inverse, stiffness);
  const V rate = hn::Mul(way, hn::Mul(inverse, inverse));
  const V c = all_damping == nullptr ? hn::Mul(damping_time, stiffness) : hn::LoadU(d, all_damping);
  const V damping = hn::Mul(c, rate);
  return {hn::Add(elastic, damping), damping};
}

/// Forces of eight springs at two nodes, off one end and onto the other.
HWY_INLINE void scatter(const V8 scale, const V8 (&apart)[8], const std::uint16_t* other,
                        std::uint16_t own0, std::uint16_t own1, NodeVector<float>* forces) {
  const F4 d;
  const V4 lower = hn::LowerHalf(d, scale);
  const V4 upper = hn::UpperHalf(d, scale);
  const V4 f[8] = {hn::Mul(hn::Broadcast<0>(lower), hn::LowerHalf(d, apart[0])),
                   hn::Mul(hn::Broadcast<1>(lower), hn::LowerHalf(d, apart[1])),
                   hn::Mul(hn::Broadcast<2>(lower), hn::LowerHalf(d, apart[2])),
                   hn::Mul(hn::Broadcast<3>(lower), hn::LowerHalf(d, apart[3])),
                   hn::Mul(hn::Broadcast<0>(upper), hn::LowerHalf(d, apart[4])),
                   hn::Mul(hn::Broadcast<1>(upper), hn::LowerHalf(d, apart[5])),
                   hn::Mul(hn::Broadcast<2>(upper), hn::LowerHalf(d, apart[6])),
                   hn::Mul(hn::Broadcast<3>(upper), hn::LowerHalf(d, apart[7]))};
  for (int i = 0; i < 8; ++i) {
    float* at = force_at(forces, other[i]);
    hn::Store(hn::Sub(hn::Load(d, at), f[i]), d, at);
  }
  const auto give = [&](std::uint16_t index, V4 force) {
    float* at = force_at(forces, index);
    hn::Store(hn::Add(hn::Load(d, at), force), d, at);
  };
  give(own0, hn::Add(hn::Add(f[0], f[1]), hn::Add(f[2], f[3])));
  give(own1, hn::Add(hn::Add(f[4], f[5]), hn::Add(f[6], f[7])));
}

template <bool with_damping>
void add_forces(const QuadBlock<float>& block, float damping_time, QuadBlockState<float>& state) {
  const F8 d;
  const NodeRecord<float>* HWY_RESTRICT records = state.records.data();
  const V8 beta = hn::Set(d, damping_time);
  const auto record = [&](std::size_t index) { return hn::Load(d, record_at(records, index).x); };
  for (std::size_t n = 0; n < block.pairs.size(); ++n) {
    const QuadPair<float>& pair = block.pairs[n];
    const std::uint16_t* HWY_RESTRICT other = pair.other;
    const std::uint16_t own0 = pair.own[0];
    const std::uint16_t own1 = pair.own[1];
    const V8 record0 = record(own0);
    const V8 record1 = record(own1);
    const V8 apart[8] = {hn::Sub(record(other[0]), record0), hn::Sub(record(other[1]), record0),
                         hn::Sub(record(other[2]), record0), hn::Sub(record(other[3]), record0),
                         hn::Sub(record(other[4]), record1), hn::Sub(record(other[5]), record1),
                         hn::Sub(record(other[6]), record1), hn::Sub(record(other[7]), record1)};
    const Side<V8> a = transpose(apart[0], apart[1], apart[2], apart[3]);
    const Side<V8> b = transpose(apart[4], apart[5], apart[6], apart[7]);
    const Side<V8> x{hn::ConcatLowerLower(d, b.x, a.x), hn::ConcatLowerLower(d, b.y, a.y),
                     hn::ConcatLowerLower(d, b.z, a.z)};
    const Side<V8> v{hn::ConcatUpperUpper(d, b.x, a.x), hn::ConcatUpperUpper(d, b.y, a.y),
                     hn::ConcatUpperUpper(d, b.z, a.z)};
    const float* damping = block.damping.empty() ? nullptr : block.damping[n].data();
    const Pull<V8> scale = pull(d, x, v, pair.stiffness, pair.rest_force, damping, beta);
    scatter(scale.both, apart, other, own0, own1, state.forces.data());
    if constexpr (with_damping)
      scatter(scale.damping, apart, other, own0, own1, state.damping_forces.data());
  }
}

/// Forces of four springs at one node.
HWY_INLINE void scatter(const W4 scale, const W4 (&apart)[4], const std::uint16_t* other,
                        std::uint16_t own, NodeVector<double>* forces) {
  const D4 d;
  const W4 even = hn::DupEven(scale);
  const W4 odd = hn::DupOdd(scale);
  const W4 f[4] = {hn::Mul(hn::ConcatLowerLower(d, even, even), apart[0]),
                   hn::Mul(hn::ConcatLowerLower(d, odd, odd), apart[1]),
                   hn::Mul(hn::ConcatUpperUpper(d, even, even), apart[2]),
                   hn::Mul(hn::ConcatUpperUpper(d, odd, odd), apart[3])};
  for (int i = 0; i < 4; ++i) {
    double* at = force_at(forces, other[i]);
    hn::Store(hn::Sub(hn::Load(d, at), f[i]), d, at);
  }
  const W4 sum = hn::Add(hn::Add(f[0], f[1]), hn::Add(f[2], f[3]));
  double* at = force_at(forces, own);
  hn::Store(hn::Add(hn::Load(d, at), sum), d, at);
}

template <bool with_damping>
void add_forces(const QuadBlock<double>& block, double damping_time,
                QuadBlockState<double>& state) {
  const D4 d;
  const NodeRecord<double>* HWY_RESTRICT records = state.records.data();
  const W4 beta = hn::Set(d, damping_time);
  const auto record = [&](std::size_t index) -> const NodeRecord<double>& {
    return record_at(records, index);
  };
  for (std::size_t q = 0; q < 2 * block.pairs.size(); ++q) {
    const QuadPair<double>& pair = block.pairs[q / 2];
    const std::size_t first = kQuad * (q % 2);
    const std::uint16_t* HWY_RESTRICT other = pair.other + first;
    const std::uint16_t own = pair.own[q % 2];
    const W4 own_x = hn::Load(d, record(own).x);
    const W4 own_v = hn::Load(d, record(own).v);
    const W4 apart[4] = {hn::Sub(hn::Load(d, record(other[0]).x), own_x),
                         hn::Sub(hn::Load(d, record(other[1]).x), own_x),
                         hn::Sub(hn::Load(d, record(other[2]).x), own_x),
                         hn::Sub(hn::Load(d, record(other[3]).x), own_x)};
    const Side<W4> x = transpose(apart[0], apart[1], apart[2], apart[3]);
    const Side<W4> v = transpose(hn::Sub(hn::Load(d, record(other[0]).v), own_v),
                                 hn::Sub(hn::Load(d, record(other[1]).v), own_v),
                                 hn::Sub(hn::Load(d, record(other[2]).v), own_v),
                                 hn::Sub(hn::Load(d, record(other[3]).v), own_v));
    const double* damping = block.damping.empty() ? nullptr : block.damping[q / 2].data() + first;
    const Pull<W4> scale =
        pull(d, x, v, pair.stiffness + first, pair.rest_force + first, damping, beta);
    scatter(scale.both, apart, other, own, state.forces.data());
    if constexpr (with_damping)
      scatter(scale.damping, apart, other, own, state.damping_forces.data());
  }
}

#else

template <bool with_damping, class Real>
void add_forces(const QuadBlock<Real>& block, Real damping_time, QuadBlockState<Real>& state) {
  add_forces_plainly<with_damping>(block, damping_time, state);
}

#endif

template <class Real>
void find_forces(const QuadLayout<Real>& layout, std::uint32_t number, QuadState<Real>& state) {
  const QuadBlock<Real>& block = layout.blocks[number];
  QuadBlockState<Real>& own = state[number];
  for (std::size_t h = 0; h < block.halo.size(); ++h)
    own.records[block.own + h] = state[block.halo[h].block].records[block.halo[h].index];
  std::fill(own.forces.begin(), own.forces.end(), NodeVector<Real>{});
  std::fill(own.damping_forces.begin(), own.damping_forces.end(), NodeVector<Real>{});
  const auto damping_time = static_cast<Real>(layout.damping_time);
  if (own.damping_forces.empty())
    add_forces<false>(block, damping_time, own);
  else
    add_forces<true>(block, damping_time, own);
}

/// What other blocks worked out on their copies of this one's nodes.
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

template <class Real>
void find_nodes(const QuadLayout<Real>& layout, std::uint32_t number, const QuadState<Real>& state,
                const Box3& region, std::vector<std::uint32_t>& indices) {
  const Corner<Real> d;
  const QuadBlockState<Real>& own = state[number];
  NodeVector<Real> low;
  NodeVector<Real> high;
  for (int axis = 0; axis < 3; ++axis) {
    low.at[axis] = static_cast<Real>(region.min()[axis]);
    high.at[axis] = static_cast<Real>(region.max()[axis]);
  }
  for (std::uint32_t i = 0; i < layout.blocks[number].own; ++i) {
    bool inside = true;
    for (std::size_t lane = 0; lane < 4; lane += hn::Lanes(d)) {
      const auto x = hn::Load(d, own.records[i].x + lane);
      inside &= hn::AllTrue(d, hn::And(hn::Ge(x, hn::Load(d, low.at + lane)),
                                       hn::Le(x, hn::Load(d, high.at + lane))));
    }
    if (inside) indices.push_back(i);
  }
}

template <class Real>
void kick_nodes(const QuadBlock<Real>& block, Real time, QuadBlockState<Real>& own) {
  const Corner<Real> d;
  for (std::uint32_t i = 0; i < block.own; ++i)
    for (std::size_t lane = 0; lane < 4; lane += hn::Lanes(d)) {
      const auto factor = hn::Set(d, time * block.inverse_mass[i]);
      Real* v = own.records[i].v + lane;
      hn::Store(hn::MulAdd(factor, hn::Load(d, own.forces[i].at + lane), hn::Load(d, v)), d, v);
    }
}

template <class Real>
void drift_nodes(const QuadBlock<Real>& block, Real time, QuadBlockState<Real>& own) {
  const Corner<Real> d;
  NodeVector<Real> least;
  NodeVector<Real> most;
  std::fill_n(least.at, 4, std::numeric_limits<Real>::max());
  std::fill_n(most.at, 4, std::numeric_limits<Real>::lowest());
  for (std::size_t lane = 0; lane < 4; lane += hn::Lanes(d)) {
    auto low_corner = hn::Load(d, least.at + lane);
    auto high_corner = hn::Load(d, most.at + lane);
    for (std::uint32_t i = 0; i < block.own; ++i) {
      NodeRecord<Real>& record = own.records[i];
      const auto way = hn::Mul(hn::Set(d, time), hn::Load(d, record.v + lane));
      const auto from = hn::Load(d, record.x + lane);
      auto to = hn::Add(from, way);
      if constexpr (sizeof(Real) == sizeof(float)) {
        Real* low = own.low[i].at + lane;
        const auto whole = hn::Add(way, hn::Load(d, low));
        to = hn::Add(from, whole);
        hn::Store(hn::Sub(whole, hn::Sub(to, from)), d, low);
      }
      hn::Store(to, d, record.x + lane);
      low_corner = hn::Min(low_corner, to);
      high_corner = hn::Max(high_corner, to);
    }
    hn::Store(low_corner, d, least.at + lane);
    hn::Store(high_corner, d, most.at + lane);
  }
  for (int axis = 0; axis < 3; ++axis) {
    own.bounds.min()[axis] = static_cast<double>(least.at[axis]);
    own.bounds.max()[axis] = static_cast<double>(most.at[axis]);
  }
}

template <class Real>
void move(const QuadLayout<Real>& layout, std::uint32_t number, double kick, double drift,
          QuadState<Real>& state) {
  const QuadBlock<Real>& block = layout.blocks[number];
  if (kick != 0) kick_nodes(block, static_cast<Real>(kick), state[number]);
  if (drift != 0) drift_nodes(block, static_cast<Real>(drift), state[number]);
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
          .move = move<Real>,
          .find_nodes = find_nodes<Real>};
}
QuadKernels<float> quad_kernels_float() {
  return kernels<float>();
}
QuadKernels<double> quad_kernels_double() {
  return kernels<double>();
}
const char* target_name() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace springlod::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace springlod {

HWY_EXPORT(quad_kernels_float);
HWY_EXPORT(quad_kernels_double);
HWY_EXPORT(target_name);

template <>
QuadKernels<float> quad_kernels() {
  return HWY_DYNAMIC_DISPATCH(quad_kernels_float)();
}
template <>
QuadKernels<double> quad_kernels() {
  return HWY_DYNAMIC_DISPATCH(quad_kernels_double)();
}

const char* vector_target() {
  return HWY_DYNAMIC_DISPATCH(target_name)();
}

}  // namespace springlod
#endif
