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

/// Springs of a block without vectors.
template <class Real>
void add_forces_plainly(const QuadBlock<Real>& block, Real damping_time,
                        QuadBlockState<Real>& state) {
  for (std::size_t s = 0; s < block.other_end.size(); ++s) {
    const std::uint16_t a = block.quad_node[s / kQuad];
    const std::uint16_t b = block.other_end[s];
    const NodeRecord<Real>& p = state.records[a];
    const NodeRecord<Real>& q = state.records[b];
    const Real x[3] = {q.x[0] - p.x[0], q.x[1] - p.x[1], q.x[2] - p.x[2]};
    const Real square = std::max(x[0] * x[0] + x[1] * x[1] + x[2] * x[2],
                                 static_cast<Real>(kShortestSquare));
    const Real rate =
        x[0] * (q.v[0] - p.v[0]) + x[1] * (q.v[1] - p.v[1]) + x[2] * (q.v[2] - p.v[2]);
    const Real damping =
        block.damping.empty() ? damping_time * block.stiffness[s] : block.damping[s];
    const Real scale = block.stiffness[s] - block.rest_force[s] / std::sqrt(square) +
                       damping * rate / square;
    for (int i = 0; i < 3; ++i) {
      state.forces[a].at[i] += scale * x[i];
      state.forces[b].at[i] -= scale * x[i];
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

/// (k (l - L) + c dl/dt) / l of springs whose ends differ by x and v.
template <bool one_damping_time, class D, class Real, class V>
HWY_INLINE V force_over_length(D d, const Side<V>& x, const Side<V>& v,
                               const QuadBlock<Real>& block, std::size_t first, V damping_time) {
  const V square = hn::MulAdd(x.x, x.x, hn::MulAdd(x.y, x.y, hn::Mul(x.z, x.z)));
  const V way = hn::MulAdd(x.x, v.x, hn::MulAdd(x.y, v.y, hn::Mul(x.z, v.z)));  // l dl/dt
  const V inverse = inverse_root(d, square);
  const V stiffness = hn::LoadU(d, &block.stiffness[first]);
  const V elastic = hn::NegMulAdd(hn::LoadU(d, &block.rest_force[first]), inverse, stiffness);
  V damping;
  if constexpr (one_damping_time)
    damping = hn::Mul(damping_time, stiffness);
  else
    damping = hn::LoadU(d, &block.damping[first]);
  return hn::MulAdd(damping, hn::Mul(way, hn::Mul(inverse, inverse)), elastic);
}

template <bool one_damping_time>
void add_forces(const QuadBlock<float>& block, float damping_time, QuadBlockState<float>& state) {
  const F8 d8;
  const F4 d4;
  const NodeRecord<float>* HWY_RESTRICT records = state.records.data();
  NodeVector<float>* HWY_RESTRICT forces = state.forces.data();
  const V8 beta = hn::Set(d8, damping_time);
  const auto record = [&](std::uint32_t index) { return hn::Load(d8, records[index].x); };
  const auto take = [&](std::uint16_t index, V4 force) {
    hn::Store(hn::Sub(hn::Load(d4, forces[index].at), force), d4, forces[index].at);
  };
  const auto give = [&](std::uint16_t index, V4 force) {
    hn::Store(hn::Add(hn::Load(d4, forces[index].at), force), d4, forces[index].at);
  };
  for (std::size_t q = 0; q < block.quad_node.size(); q += 2) {
    const std::uint16_t* HWY_RESTRICT other = &block.other_end[kQuad * q];
    const std::uint16_t own0 = block.quad_node[q];
    const std::uint16_t own1 = block.quad_node[q + 1];
    const V8 own_record0 = record(own0);
    const V8 own_record1 = record(own1);
    const V8 w0 = hn::Sub(record(other[0]), own_record0);
    const V8 w1 = hn::Sub(record(other[1]), own_record0);
    const V8 w2 = hn::Sub(record(other[2]), own_record0);
    const V8 w3 = hn::Sub(record(other[3]), own_record0);
    const V8 w4 = hn::Sub(record(other[4]), own_record1);
    const V8 w5 = hn::Sub(record(other[5]), own_record1);
    const V8 w6 = hn::Sub(record(other[6]), own_record1);
    const V8 w7 = hn::Sub(record(other[7]), own_record1);
    const Side<V8> a = transpose(w0, w1, w2, w3);
    const Side<V8> b = transpose(w4, w5, w6, w7);
    const Side<V8> x{hn::ConcatLowerLower(d8, b.x, a.x), hn::ConcatLowerLower(d8, b.y, a.y),
                     hn::ConcatLowerLower(d8, b.z, a.z)};
    const Side<V8> v{hn::ConcatUpperUpper(d8, b.x, a.x), hn::ConcatUpperUpper(d8, b.y, a.y),
                     hn::ConcatUpperUpper(d8, b.z, a.z)};
    const V8 scale = force_over_length<one_damping_time>(d8, x, v, block, kQuad * q, beta);
    const V4 lower = hn::LowerHalf(d4, scale);
    const V4 upper = hn::UpperHalf(d4, scale);
    const V4 f0 = hn::Mul(hn::Broadcast<0>(lower), hn::LowerHalf(d4, w0));
    const V4 f1 = hn::Mul(hn::Broadcast<1>(lower), hn::LowerHalf(d4, w1));
    const V4 f2 = hn::Mul(hn::Broadcast<2>(lower), hn::LowerHalf(d4, w2));
    const V4 f3 = hn::Mul(hn::Broadcast<3>(lower), hn::LowerHalf(d4, w3));
    const V4 f4 = hn::Mul(hn::Broadcast<0>(upper), hn::LowerHalf(d4, w4));
    const V4 f5 = hn::Mul(hn::Broadcast<1>(upper), hn::LowerHalf(d4, w5));
    const V4 f6 = hn::Mul(hn::Broadcast<2>(upper), hn::LowerHalf(d4, w6));
    const V4 f7 = hn::Mul(hn::Broadcast<3>(upper), hn::LowerHalf(d4, w7));
    take(other[0], f0);
    take(other[1], f1);
    take(other[2], f2);
    take(other[3], f3);
    take(other[4], f4);
    take(other[5], f5);
    take(other[6], f6);
    take(other[7], f7);
    give(own0, hn::Add(hn::Add(f0, f1), hn::Add(f2, f3)));
    give(own1, hn::Add(hn::Add(f4, f5), hn::Add(f6, f7)));
  }
}

template <bool one_damping_time>
void add_forces(const QuadBlock<double>& block, double damping_time,
                QuadBlockState<double>& state) {
  const D4 d;
  const NodeRecord<double>* HWY_RESTRICT records = state.records.data();
  NodeVector<double>* HWY_RESTRICT forces = state.forces.data();
  const W4 beta = hn::Set(d, damping_time);
  const auto take = [&](std::uint16_t index, W4 force) {
    hn::Store(hn::Sub(hn::Load(d, forces[index].at), force), d, forces[index].at);
  };
  for (std::size_t q = 0; q < block.quad_node.size(); ++q) {
    const std::uint16_t* HWY_RESTRICT other = &block.other_end[kQuad * q];
    const std::uint16_t own = block.quad_node[q];
    const W4 own_x = hn::Load(d, records[own].x);
    const W4 own_v = hn::Load(d, records[own].v);
    const W4 w0 = hn::Sub(hn::Load(d, records[other[0]].x), own_x);
    const W4 w1 = hn::Sub(hn::Load(d, records[other[1]].x), own_x);
    const W4 w2 = hn::Sub(hn::Load(d, records[other[2]].x), own_x);
    const W4 w3 = hn::Sub(hn::Load(d, records[other[3]].x), own_x);
    const Side<W4> x = transpose(w0, w1, w2, w3);
    const Side<W4> v = transpose(hn::Sub(hn::Load(d, records[other[0]].v), own_v),
                                 hn::Sub(hn::Load(d, records[other[1]].v), own_v),
                                 hn::Sub(hn::Load(d, records[other[2]].v), own_v),
                                 hn::Sub(hn::Load(d, records[other[3]].v), own_v));
    const W4 scale = force_over_length<one_damping_time>(d, x, v, block, kQuad * q, beta);
    const W4 even = hn::DupEven(scale);
    const W4 odd = hn::DupOdd(scale);
    const W4 f0 = hn::Mul(hn::ConcatLowerLower(d, even, even), w0);
    const W4 f1 = hn::Mul(hn::ConcatLowerLower(d, odd, odd), w1);
    const W4 f2 = hn::Mul(hn::ConcatUpperUpper(d, even, even), w2);
    const W4 f3 = hn::Mul(hn::ConcatUpperUpper(d, odd, odd), w3);
    take(other[0], f0);
    take(other[1], f1);
    take(other[2], f2);
    take(other[3], f3);
    const W4 sum = hn::Add(hn::Add(f0, f1), hn::Add(f2, f3));
    hn::Store(hn::Add(hn::Load(d, forces[own].at), sum), d, forces[own].at);
  }
}

#else

template <bool one_damping_time, class Real>
void add_forces(const QuadBlock<Real>& block, Real damping_time, QuadBlockState<Real>& state) {
  add_forces_plainly(block, damping_time, state);
}

#endif

template <class Real>
void find_forces(const QuadLayout<Real>& layout, std::uint32_t number, QuadState<Real>& state) {
  const QuadBlock<Real>& block = layout.blocks[number];
  QuadBlockState<Real>& own = state[number];
  for (std::size_t h = 0; h < block.halo.size(); ++h)
    own.records[block.own + h] = state[block.halo[h].block].records[block.halo[h].index];
  const auto damping_time = static_cast<Real>(layout.damping_time);
  if (block.damping.empty())
    add_forces<true>(block, damping_time, own);
  else
    add_forces<false>(block, damping_time, own);
}

/// The forces on the copies of own nodes, which are 0 from then on.
template <class Real>
void collect(const QuadBlock<Real>& block, QuadBlockState<Real>& own, QuadState<Real>& state) {
  for (const CopiedForce& c : block.copied) {
    NodeVector<Real>& copy = state[c.copy.block].forces[c.copy.index];
    for (int i = 0; i < 4; ++i) own.forces[c.own].at[i] += copy.at[i];
    copy = {};
  }
}

template <class Real>
void move(const QuadLayout<Real>& layout, std::uint32_t number, Real kick, Real drift,
          QuadState<Real>& state) {
  const QuadBlock<Real>& block = layout.blocks[number];
  QuadBlockState<Real>& own = state[number];
  collect(block, own, state);
  const hn::CappedTag<Real, 4> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto drift_time = hn::Set(d, drift);
  NodeVector<Real> least;
  NodeVector<Real> most;
  std::fill_n(least.at, 4, std::numeric_limits<Real>::max());
  std::fill_n(most.at, 4, std::numeric_limits<Real>::lowest());
  for (std::size_t lane = 0; lane < 4; lane += lanes) {
    auto low_corner = hn::Load(d, least.at + lane);
    auto high_corner = hn::Load(d, most.at + lane);
    for (std::uint32_t i = 0; i < block.own; ++i) {
      NodeRecord<Real>& record = own.records[i];
      const auto factor = hn::Set(d, kick * block.inverse_mass[i]);
      const auto v = hn::MulAdd(factor, hn::Load(d, own.forces[i].at + lane),
                                hn::Load(d, record.v + lane));
      hn::Store(hn::Zero(d), d, own.forces[i].at + lane);
      hn::Store(v, d, record.v + lane);
      const auto from = hn::Load(d, record.x + lane);
      auto to = hn::MulAdd(drift_time, v, from);
      if constexpr (sizeof(Real) == sizeof(float)) {
        Real* low = own.low[i].at + lane;
        const auto way = hn::MulAdd(drift_time, v, hn::Load(d, low));
        to = hn::Add(from, way);
        hn::Store(hn::Sub(way, hn::Sub(to, from)), d, low);
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

void find_forces_float(const QuadLayout<float>& layout, std::uint32_t block,
                       QuadState<float>& state) {
  find_forces(layout, block, state);
}
void find_forces_double(const QuadLayout<double>& layout, std::uint32_t block,
                        QuadState<double>& state) {
  find_forces(layout, block, state);
}
void move_float(const QuadLayout<float>& layout, std::uint32_t block, double kick, double drift,
                QuadState<float>& state) {
  move(layout, block, static_cast<float>(kick), static_cast<float>(drift), state);
}
void move_double(const QuadLayout<double>& layout, std::uint32_t block, double kick, double drift,
                 QuadState<double>& state) {
  move(layout, block, kick, drift, state);
}
const char* target_name() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace springlod::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace springlod {

HWY_EXPORT(find_forces_float);
HWY_EXPORT(find_forces_double);
HWY_EXPORT(move_float);
HWY_EXPORT(move_double);
HWY_EXPORT(target_name);

void find_quad_forces(const QuadLayout<float>& layout, std::uint32_t block,
                      QuadState<float>& state) {
  HWY_DYNAMIC_DISPATCH(find_forces_float)(layout, block, state);
}
void find_quad_forces(const QuadLayout<double>& layout, std::uint32_t block,
                      QuadState<double>& state) {
  HWY_DYNAMIC_DISPATCH(find_forces_double)(layout, block, state);
}
void move_quads(const QuadLayout<float>& layout, std::uint32_t block, double kick, double drift,
                QuadState<float>& state) {
  HWY_DYNAMIC_DISPATCH(move_float)(layout, block, kick, drift, state);
}
void move_quads(const QuadLayout<double>& layout, std::uint32_t block, double kick, double drift,
                QuadState<double>& state) {
  HWY_DYNAMIC_DISPATCH(move_double)(layout, block, kick, drift, state);
}
const char* vector_target() {
  return HWY_DYNAMIC_DISPATCH(target_name)();
}

}  // namespace springlod
#endif
