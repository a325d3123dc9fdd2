#include "sim/fast/quad_body.hpp"

namespace springlod {
namespace {

/// What a number loses when it is rounded to Real.
template <class Real>
Real rounding_of(double number) {
  return static_cast<Real>(number - static_cast<double>(static_cast<Real>(number)));
}

template <class Real>
Vec3 read(const Real (&from)[4]) {
  return {static_cast<double>(from[0]), static_cast<double>(from[1]), static_cast<double>(from[2])};
}
template <class Real>
void add(const Vec3& more, Real (&to)[4]) {
  for (int axis = 0; axis < 3; ++axis) to[axis] += static_cast<Real>(more[axis]);
}

}  // namespace

template <class Real>
QuadBody<Real>::QuadBody(const QuadLayout<Real>& layout, bool with_damping)
    : layout_(&layout), state_(layout.blocks.size()) {
  for (std::size_t b = 0; b < state_.size(); ++b) {
    const QuadBlock<Real>& block = layout.blocks[b];
    state_[b].records.resize(block.nowhere() + 1);
    state_[b].forces.resize(block.nowhere() + 1);
    if (with_damping) state_[b].damping_forces.resize(block.nowhere() + 1);
    if constexpr (sizeof(Real) == sizeof(float)) state_[b].low.resize(block.own);
  }
}

template <class Real>
void QuadBody<Real>::set(const std::vector<Vec3>& x, const std::vector<Vec3>& v) {
  for (QuadBlockState<Real>& block : state_) block.bounds.setEmpty();
  for (std::size_t n = 0; n < x.size(); ++n) {
    const Place at = layout_->place[n];
    QuadBlockState<Real>& block = state_[at.block];
    NodeRecord<Real>& record = block.records[at.index];
    for (int axis = 0; axis < 3; ++axis) {
      record.x[axis] = static_cast<Real>(x[n][axis]);
      record.v[axis] = static_cast<Real>(v[n][axis]);
      if (!block.low.empty()) block.low[at.index].at[axis] = rounding_of<Real>(x[n][axis]);
    }
    block.bounds.extend(read(record.x));
  }
}

template <class Real>
void QuadBody<Real>::get(std::vector<Vec3>& x, std::vector<Vec3>& v) const {
  for (std::size_t n = 0; n < x.size(); ++n) {
    const Place at = layout_->place[n];
    const QuadBlockState<Real>& block = state_[at.block];
    x[n] = read(block.records[at.index].x);
    if (!block.low.empty()) x[n] += read(block.low[at.index].at);
    v[n] = read(block.records[at.index].v);
  }
}

template <class Real>
Vec3 QuadBody<Real>::x(Place at) const {
  return read(state_[at.block].records[at.index].x);
}

template <class Real>
Vec3 QuadBody<Real>::v(Place at) const {
  return read(state_[at.block].records[at.index].v);
}

template <class Real>
void QuadBody<Real>::add_force(Place at, const Vec3& force) {
  add(force, state_[at.block].forces[at.index].at);
}

template <class Real>
void QuadBody<Real>::add_velocity(Place at, const Vec3& more) {
  add(more, state_[at.block].records[at.index].v);
}

template class QuadBody<float>;
template class QuadBody<double>;

}  // namespace springlod
