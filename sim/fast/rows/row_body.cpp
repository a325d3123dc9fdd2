#include "sim/fast/rows/row_body.hpp"

#include <cassert>

namespace springlod::sim {
namespace {

template <class Real>
Vec3 read(const typename RowState<Real>::Coordinates& from, std::uint32_t position) {
  return {static_cast<double>(from[0][position]), static_cast<double>(from[1][position]),
          static_cast<double>(from[2][position])};
}

}  // namespace

template <class Real>
std::span<const std::uint32_t> RowBody<Real>::nodes(std::uint32_t block) const {
  const RowBlock& of = this->layout_->blocks[block];
  return std::span(this->layout_->node).subspan(of.first, of.own);
}

// The padding of the last row repeats the position of the last node, so that no spring there has
// zero length.
template <class Real>
void RowBody<Real>::set(std::uint32_t block, const MovingFrame& frame, const std::vector<Vec3>& x,
                        const std::vector<Vec3>& v) {
  const RowBlock& of = this->layout_->blocks[block];
  const std::span<const std::uint32_t> nodes = this->nodes(block);
  assert(!nodes.empty() && nodes.size() <= of.places());
  assert(x.size() == v.size());
  for (std::uint32_t i = 0; i < of.places(); ++i) {
    const bool fills_up = i >= nodes.size();
    const std::uint32_t node = fills_up ? nodes.back() : nodes[i];
    const Vec3 own_x = x[node] - frame.origin;
    const Vec3 own_v = fills_up ? Vec3(Vec3::Zero()) : Vec3(v[node] - frame.velocity);
    const std::uint32_t place = of.first + i;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto of_vector = static_cast<Eigen::Index>(axis);
      this->state_.x[axis][place] = static_cast<Real>(own_x[of_vector]);
      this->state_.v[axis][place] = static_cast<Real>(own_v[of_vector]);
      if (this->state_.low[axis])
        this->state_.low[axis][place] = rounding_of<Real>(own_x[of_vector]);
    }
  }
  Box3& bounds = this->state_.bounds[block];
  bounds.setEmpty();
  for (std::uint32_t i = 0; i < of.own; ++i)
    bounds.extend(read<Real>(this->state_.x, of.first + i));
}

template <class Real>
void RowBody<Real>::get_x(std::uint32_t block, const MovingFrame& frame,
                          std::vector<Vec3>& x) const {
  const std::span<const std::uint32_t> nodes = this->nodes(block);
  const std::uint32_t first = this->layout_->blocks[block].first;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    Vec3 own_x = read<Real>(this->state_.x, first + i);
    if (this->state_.low[0]) own_x += read<Real>(this->state_.low, first + i);
    x[nodes[i]] = frame.origin + own_x;
  }
}

template <class Real>
void RowBody<Real>::get_v(std::uint32_t block, const MovingFrame& frame,
                          std::vector<Vec3>& v) const {
  const std::span<const std::uint32_t> nodes = this->nodes(block);
  const std::uint32_t first = this->layout_->blocks[block].first;
  for (std::uint32_t i = 0; i < nodes.size(); ++i)
    v[nodes[i]] = frame.velocity + read<Real>(this->state_.v, first + i);
}

template <class Real>
void RowBody<Real>::get_motions(std::span<const std::uint32_t> nodes, const MovingFrame& frame,
                                std::span<NodeMotion> motions) const {
  assert(nodes.size() == motions.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::uint32_t at = position(this->place(nodes[i]));
    motions[i] = {frame.origin + read<Real>(this->state_.x, at),
                  frame.velocity + read<Real>(this->state_.v, at)};
  }
}

template <class Real>
void RowBody<Real>::get_elastic_forces(std::span<const std::uint32_t> nodes,
                                       std::span<Vec3> forces) const {
  assert(nodes.size() == forces.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Place at = this->place(nodes[i]);
    forces[i] = read<Real>(this->state_.force[at.block], at.index) -
                read<Real>(this->state_.damping_force[at.block], at.index);
  }
}

template <class Real>
void RowBody<Real>::count_departures(std::span<const std::uint32_t> nodes, bool counts) {
  for (const std::uint32_t node : nodes)
    this->state_.counts[position(this->place(node))] = counts ? Real(1) : Real(0);
}

template <class Real>
void RowBody<Real>::shift(std::span<const NodeChange> changes) {
  RowState<Real>& state = this->state_;
  for (const NodeChange& change : changes) {
    const Place place = this->place(change.node);
    const std::uint32_t at = position(place);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto of_vector = static_cast<Eigen::Index>(axis);
      Real& x = state.x[axis][at];
      double to = static_cast<double>(x) + change.displacement[of_vector];
      if constexpr (sizeof(Real) == sizeof(float)) {
        Real& low = state.low[axis][at];
        to += static_cast<double>(low);
        low = rounding_of<Real>(to);
      }
      x = static_cast<Real>(to);
      Real& v = state.v[axis][at];
      v = static_cast<Real>(static_cast<double>(v) + change.kick[of_vector]);
    }
    state.bounds[place.block].extend(read<Real>(state.x, at));
  }
}

template class RowBody<float>;
template class RowBody<double>;

}  // namespace springlod::sim
