#include "sim/fast/quads/quad_body.hpp"

#include <cassert>

namespace springlod::sim {
namespace {

template <class Real>
Vec3 read(const Real (&from)[4]) {
  return {static_cast<double>(from[0]), static_cast<double>(from[1]), static_cast<double>(from[2])};
}

template <class Real>
QuadState<Real> zero_state(const QuadLayout<Real>& layout, bool with_damping) {
  QuadState<Real> state(layout.blocks.size());
  for (std::size_t b = 0; b < state.size(); ++b) {
    const QuadBlock<Real>& block = layout.blocks[b];
    state[b].counts.assign(block.own, Real(1));
    state[b].corner_dues = CornerDues(block.corners.size());
    state[b].records.resize(block.indices());
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
std::span<const std::uint32_t> QuadBody<Real>::nodes(std::uint32_t block) const {
  return this->layout_->blocks[block].node;
}

template <class Real>
void QuadBody<Real>::set(std::uint32_t block, const MovingFrame& frame, const std::vector<Vec3>& x,
                         const std::vector<Vec3>& v) {
  QuadBlockState<Real>& own = this->state_[block];
  own.bounds.setEmpty();
  const std::span<const std::uint32_t> nodes = this->nodes(block);
  assert(nodes.size() <= own.records.size() && x.size() == v.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec3 own_x = x[nodes[i]] - frame.origin;
    const Vec3 own_v = v[nodes[i]] - frame.velocity;
    NodeRecord<Real>& record = own.records[i];
    for (int axis = 0; axis < 3; ++axis) {
      record.x[axis] = static_cast<Real>(own_x[axis]);
      record.v[axis] = static_cast<Real>(own_v[axis]);
      if (!own.low.empty()) own.low[i].at[axis] = rounding_of<Real>(own_x[axis]);
    }
    own.bounds.extend(read(record.x));
  }
}

template <class Real>
void QuadBody<Real>::get_x(std::uint32_t block, const MovingFrame& frame,
                           std::vector<Vec3>& x) const {
  const QuadBlockState<Real>& own = this->state_[block];
  const std::span<const std::uint32_t> nodes = this->nodes(block);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    Vec3 own_x = read(own.records[i].x);
    if (!own.low.empty()) own_x += read(own.low[i].at);
    x[nodes[i]] = frame.origin + own_x;
  }
}

template <class Real>
void QuadBody<Real>::get_v(std::uint32_t block, const MovingFrame& frame,
                           std::vector<Vec3>& v) const {
  const QuadBlockState<Real>& own = this->state_[block];
  const std::span<const std::uint32_t> nodes = this->nodes(block);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    v[nodes[i]] = frame.velocity + read(own.records[i].v);
}

template <class Real>
void QuadBody<Real>::get_motions(std::span<const std::uint32_t> nodes, const MovingFrame& frame,
                                 std::span<NodeMotion> motions) const {
  assert(nodes.size() == motions.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Place at = this->place(nodes[i]);
    const NodeRecord<Real>& record = this->state_[at.block].records[at.index];
    motions[i] = {frame.origin + read(record.x), frame.velocity + read(record.v)};
  }
}

template <class Real>
void QuadBody<Real>::get_elastic_forces(std::span<const std::uint32_t> nodes,
                                        std::span<Vec3> forces) const {
  assert(nodes.size() == forces.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Place at = this->place(nodes[i]);
    const QuadBlockState<Real>& own = this->state_[at.block];
    forces[i] = read(own.forces[at.index].at) - read(own.damping_forces[at.index].at);
  }
}

template <class Real>
void QuadBody<Real>::count_departures(std::span<const std::uint32_t> nodes, bool counts) {
  for (const std::uint32_t node : nodes) {
    const Place at = this->place(node);
    this->state_[at.block].counts[at.index] = counts ? Real(1) : Real(0);
  }
}

template <class Real>
void QuadBody<Real>::shift(std::span<const NodeChange> changes) {
  for (const NodeChange& change : changes) {
    const Place at = this->place(change.node);
    QuadBlockState<Real>& own = this->state_[at.block];
    NodeRecord<Real>& record = own.records[at.index];
    for (int axis = 0; axis < 3; ++axis) {
      double to = static_cast<double>(record.x[axis]) + change.displacement[axis];
      if constexpr (sizeof(Real) == sizeof(float)) {
        Real& low = own.low[at.index].at[axis];
        to += static_cast<double>(low);
        low = rounding_of<Real>(to);
      }
      record.x[axis] = static_cast<Real>(to);
      record.v[axis] = static_cast<Real>(static_cast<double>(record.v[axis]) + change.kick[axis]);
    }
    own.bounds.extend(read(record.x));
  }
}

template class QuadBody<float>;
template class QuadBody<double>;

}  // namespace springlod::sim
