#include "sim/fast/quad_kernel.hpp"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/fast/quad_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again for every target.
#include <hwy/highway.h>

#include "sim/fast/inverse_root-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace springlod::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Without vectors.
template <class Real>
void add_forces_plainly(SpringBlock<Real>& block) {
  for (std::size_t s = 0; s < block.other_end.size(); ++s) {
    const std::uint16_t a = block.quad_node[s / 4];
    const std::uint16_t b = block.other_end[s];
    const NodeRecord<Real>& p = block.records[a];
    const NodeRecord<Real>& q = block.records[b];
    const Real x[3] = {q.x[0] - p.x[0], q.x[1] - p.x[1], q.x[2] - p.x[2]};
    const Real square = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
    const Real rate =
        x[0] * (q.v[0] - p.v[0]) + x[1] * (q.v[1] - p.v[1]) + x[2] * (q.v[2] - p.v[2]);
    const Real scale = block.stiffness[s] - block.rest_force[s] / std::sqrt(square) +
                       block.damping[s] * rate / square;
    for (int i = 0; i < 3; ++i) {
      block.forces[a].f[i] += scale * x[i];
      block.forces[b].f[i] -= scale * x[i];
    }
  }
}

#if HWY_MAX_BYTES >= 32

using F8 = hn::FixedTag<float, 8>;
using F4 = hn::FixedTag<float, 4>;
using V8 = hn::Vec<F8>;
using V4 = hn::Vec<F4>;

/// Four records' differences, places in the lower and velocities in the upper half, with their
/// coordinates side by side.
struct Quad {
  V8 x, y, z;
};
HWY_INLINE Quad transpose(V8 a, V8 b, V8 c, V8 e) {
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

void add_forces(SpringBlock<float>& block) {
  const F8 d8;
  const F4 d4;
  const NodeRecord<float>* HWY_RESTRICT records = block.records.data();
  NodeForce<float>* HWY_RESTRICT forces = block.forces.data();
  const auto record = [&](std::uint32_t place) { return hn::Load(d8, records[place].x); };
  for (std::size_t q = 0; q < block.quad_node.size(); q += 2) {
    const std::uint16_t* HWY_RESTRICT other = &block.other_end[4 * q];
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
    const Quad a = transpose(w0, w1, w2, w3);
    const Quad b = transpose(w4, w5, w6, w7);
    const V8 x = hn::ConcatLowerLower(d8, b.x, a.x);
    const V8 y = hn::ConcatLowerLower(d8, b.y, a.y);
    const V8 z = hn::ConcatLowerLower(d8, b.z, a.z);
    const V8 vx = hn::ConcatUpperUpper(d8, b.x, a.x);
    const V8 vy = hn::ConcatUpperUpper(d8, b.y, a.y);
    const V8 vz = hn::ConcatUpperUpper(d8, b.z, a.z);
    const V8 square = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
    const V8 rate = hn::MulAdd(x, vx, hn::MulAdd(y, vy, hn::Mul(z, vz)));  // l dl/dt
    const V8 inverse = inverse_root(d8, square);
    // (k (l - L) + c dl/dt) / l
    const V8 elastic = hn::NegMulAdd(hn::LoadU(d8, &block.rest_force[4 * q]), inverse,
                                     hn::LoadU(d8, &block.stiffness[4 * q]));
    const V8 drag =
        hn::Mul(hn::LoadU(d8, &block.damping[4 * q]), hn::Mul(rate, hn::Mul(inverse, inverse)));
    const V8 scale = hn::Add(elastic, drag);
    const V4 lower = hn::LowerHalf(d4, scale);
    const V4 upper = hn::UpperHalf(d4, scale);
    const auto take = [&](std::uint16_t place, V4 force) {
      hn::Store(hn::Sub(hn::Load(d4, forces[place].f), force), d4, forces[place].f);
    };
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
    const auto give = [&](std::uint16_t place, V4 force) {
      hn::Store(hn::Add(hn::Load(d4, forces[place].f), force), d4, forces[place].f);
    };
    give(own0, hn::Add(hn::Add(f0, f1), hn::Add(f2, f3)));
    give(own1, hn::Add(hn::Add(f4, f5), hn::Add(f6, f7)));
  }
}

#else

void add_forces(SpringBlock<float>& block) {
  add_forces_plainly(block);
}

#endif

void add_forces_double(SpringBlock<double>& block) {
  add_forces_plainly(block);
}
void add_forces_float(SpringBlock<float>& block) {
  add_forces(block);
}
const char* target_name() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace springlod::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace springlod {

HWY_EXPORT(add_forces_float);
HWY_EXPORT(add_forces_double);
HWY_EXPORT(target_name);

void add_block_forces(SpringBlock<float>& block) {
  HWY_DYNAMIC_DISPATCH(add_forces_float)(block);
}
void add_block_forces(SpringBlock<double>& block) {
  HWY_DYNAMIC_DISPATCH(add_forces_double)(block);
}
const char* vector_target() {
  return HWY_DYNAMIC_DISPATCH(target_name)();
}

}  // namespace springlod
#endif
