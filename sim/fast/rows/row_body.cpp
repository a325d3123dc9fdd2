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
  for (std::uint32_t i = 0; i < of.own; ++i) bounds.extend(this->x({block, i}));
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
Vec3 RowBody<Real>::x(Place at) const {
  return read<Real>(this->state_.x, position(at));
}

template <class Real>
Vec3 RowBody<Real>::v(Place at) const {
  return read<Real>(this->state_.v, position(at));
}

template <class Real>
Vec3 RowBody<Real>::force(Place at) const {
  return read<Real>(this->state_.force[at.block], at.index);
}

template <class Real>
Vec3 RowBody<Real>::damping_force(Place at) const {
  return read<Real>(this->state_.damping_force[at.block], at.index);
}

template <class Real>
void RowBody<Real>::shift(Place at, const Vec3& displacement, const Vec3& kick) {
  const std::uint32_t place = position(at);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto of_vector = static_cast<Eigen::Index>(axis);
    Real& x = this->state_.x[axis][place];
    double to = static_cast<double>(x) + displacement[of_vector];
    if (this->state_.low[axis]) {
      Real& low = this->state_.low[axis][place];
      to += static_cast<double>(low);
      low = rounding_of<Real>(to);
    }
    x = static_cast<Real>(to);
    this->state_.v[axis][place] =
        static_cast<Real>(static_cast<double>(this->state_.v[axis][place]) + kick[of_vector]);
  }
  this->state_.bounds[at.block].extend(this->x(at));
}

template class RowBody<float>;
template class RowBody<double>;

}  // namespace springlod::sim
