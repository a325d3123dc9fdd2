#pragma once

#include <utility>
#include <vector>

#include "sim/fast/fast_body.hpp"
#include "sim/fast/kernels.hpp"
#include "sim/fast/place.hpp"

namespace springlod::sim {

/// A body moved by the kernels of its layout, which must outlive it.
template <class Layout, class State>
class LaidBody : public FastBody {
 public:
  std::uint32_t block_count() const final {
    return static_cast<std::uint32_t>(layout_->blocks.size());
  }

  void find_forces(std::uint32_t block) final { kernels_.find_forces(*layout_, block, state_); }
  void collect_forces(std::uint32_t block) final {
    kernels_.collect_forces(*layout_, block, state_);
  }
  double damping_power(std::uint32_t block) const final {
    return kernels_.damping_power(*layout_, block, state_);
  }
  void move(std::uint32_t block, double kick, double drift) final {
    kernels_.move(*layout_, block, kick, drift, state_);
    if (drift != 0)
      departure_[block] = kernels_.departure(*layout_, block, drift, rigid_motion_, state_);
  }
  void set_rigid_motion(const RigidMotion& motion) final { rigid_motion_ = motion; }
  const RigidMotion& rigid_motion() const final { return rigid_motion_; }
  const Vec3& largest_departure(std::uint32_t block) const final { return departure_[block]; }
  double find_corners(std::uint32_t block, const CornerLook& look,
                      std::vector<std::uint32_t>& found) final {
    return kernels_.find_corners(*layout_, block, look, state_, found);
  }
  double largest_strain(std::uint32_t block) const final {
    return kernels_.largest_strain(*layout_, block, state_);
  }

 protected:
  LaidBody(const Layout& layout, State state, const FastKernels<Layout, State>& kernels)
      : layout_(&layout),
        state_(std::move(state)),
        departure_(layout.blocks.size(), Vec3::Zero()),
        kernels_(kernels) {}

  Place place(std::uint32_t node) const { return layout_->place[node]; }

  const Layout* layout_;
  mutable State state_;  // mutable: holds copies of other blocks' nodes, which may be out of date

 private:
  RigidMotion rigid_motion_;
  std::vector<Vec3> departure_;  // see FastBody; by block [m]
  FastKernels<Layout, State> kernels_;
};

/// The part of a number that is lost when it is rounded to Real.
template <class Real>
Real rounding_of(double number) {
  return static_cast<Real>(number - static_cast<double>(static_cast<Real>(number)));
}

}  // namespace springlod::sim
