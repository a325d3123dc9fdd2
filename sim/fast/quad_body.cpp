#include "sim/fast/quad_body.hpp"

namespace springlod {
namespace {

template <class Real>
Vec3 read(const Real (&from)[4]) {
  return {static_cast<double>(from[0]), static_cast<double>(from[1]), static_cast<double>(from[2])};
}
template <class Real>
void add(const Vec3& more, Real (&to)[4]) {
  for (int axis = 0; axis < 3; ++axis) to[axis] += static_cast<Real>(more[axis]);
}

template <class Real>
QuadState<Real> zero_state(const QuadLayout<Real>& layout, bool with_damping) {
  QuadState<Real> state(layout.blocks.size());
  for (std::size_t b = 0; b < state.size(); ++b) {
    const QuadBlock<Real>& block = layout.blocks[b];
    state[b].records.resize(block.nowhere() + 1);
    state[b].forces.resize(block.nowhere() + 1);
    if (with_damping) state[b].damping_forces.resize(block.nowhere() + 1);
    if constexpr (sizeof(Real) == sizeof(float)) state[b].low.resize(block.own);
  }
  return state;
}

}  // namespace

template <class Real>
QuadBody<Real>::QuadBody(const QuadLayout<Real>& layout, bool with_damping)
    : LaidBody<QuadLayout<Real>, QuadState<Real>>(layout, zero_state(layout, with_damping),
                                                  quad_kernels<Real>()) {}

template <class Real>
void QuadBody<Real>::set(const std::vector<Vec3>& x, const std::vector<Vec3>& v) {
  for (QuadBlockState<Real>& block : this->state_) block.bounds.setEmpty();
  for (std::size_t n = 0; n < x.size(); ++n) {
    const Place at = this->layout_->place[n];
    QuadBlockState<Real>& block = this->state_[at.block];
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
void QuadBody<Real>::get_x(std::vector<Vec3>& x) const {
  for (std::size_t n = 0; n < x.size(); ++n) {
    const Place at = this->layout_->place[n];
    const QuadBlockState<Real>& block = this->state_[at.block];
    x[n] = read(block.records[at.index].x);
    if (!block.low.empty()) x[n] += read(block.low[at.index].at);
  }
}

template <class Real>
void QuadBody<Real>::get_v(std::vector<Vec3>& v) const {
  for (std::size_t n = 0; n < v.size(); ++n) v[n] = this->v(this->layout_->place[n]);
}

template <class Real>
Vec3 QuadBody<Real>::x(Place at) const {
  return read(this->state_[at.block].records[at.index].x);
}

template <class Real>
Vec3 QuadBody<Real>::v(Place at) const {
  return read(this->state_[at.block].records[at.index].v);
}

template <class Real>
void QuadBody<Real>::add_force(Place at, const Vec3& force) {
  add(force, this->state_[at.block].forces[at.index].at);
}

template <class Real>
void QuadBody<Real>::add_velocity(Place at, const Vec3& more) {
  add(more, this->state_[at.block].records[at.index].v);
}

template class QuadBody<float>;
template class QuadBody<double>;

}  // namespace springlod
