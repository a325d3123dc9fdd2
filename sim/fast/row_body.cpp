#include "sim/fast/row_body.hpp"

namespace springlod {
namespace {

template <class Real>
Vec3 read(const typename RowState<Real>::Coordinates& from, std::uint32_t position) {
  return {static_cast<double>(from[0][position]), static_cast<double>(from[1][position]),
          static_cast<double>(from[2][position])};
}

}  // namespace

template <class Real>
void RowBody<Real>::set(const std::vector<Vec3>& x, const std::vector<Vec3>& v) {
  const std::size_t last = this->layout_->node.size() - 1;
  for (std::size_t p = 0; p < this->layout_->inverse_mass.size(); ++p) {
    const std::uint32_t node = this->layout_->node[std::min(p, last)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place = x[node][static_cast<Eigen::Index>(axis)];
      this->state_.x[axis][p] = static_cast<Real>(place);
      this->state_.v[axis][p] =
          p <= last ? static_cast<Real>(v[node][static_cast<Eigen::Index>(axis)]) : Real(0);
      if (this->state_.low[axis]) this->state_.low[axis][p] = rounding_of<Real>(place);
    }
  }
  for (std::uint32_t b = 0; b < this->block_count(); ++b) {
    this->state_.bounds[b].setEmpty();
    for (std::uint32_t i = 0; i < this->layout_->blocks[b].own; ++i)
      this->state_.bounds[b].extend(this->x({b, i}));
  }
}

template <class Real>
void RowBody<Real>::get_x(std::vector<Vec3>& x) const {
  for (std::uint32_t p = 0; p < this->layout_->node.size(); ++p) {
    x[this->layout_->node[p]] = read<Real>(this->state_.x, p);
    if (this->state_.low[0]) x[this->layout_->node[p]] += read<Real>(this->state_.low, p);
  }
}

template <class Real>
void RowBody<Real>::get_v(std::vector<Vec3>& v) const {
  for (std::uint32_t p = 0; p < this->layout_->node.size(); ++p)
    v[this->layout_->node[p]] = read<Real>(this->state_.v, p);
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
void RowBody<Real>::add_force(Place at, const Vec3& force) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    this->state_.force[at.block][axis][at.index] +=
        static_cast<Real>(force[static_cast<Eigen::Index>(axis)]);
}

template <class Real>
void RowBody<Real>::add_velocity(Place at, const Vec3& more) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    this->state_.v[axis][position(at)] += static_cast<Real>(more[static_cast<Eigen::Index>(axis)]);
}

template class RowBody<float>;
template class RowBody<double>;

}  // namespace springlod
