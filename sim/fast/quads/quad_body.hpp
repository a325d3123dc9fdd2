#pragma once

#include "sim/fast/laid_body.hpp"
#include "sim/fast/quads/quad_state.hpp"

namespace springlod::sim {

/// A body in quads. Blocks keep copies of each other's nodes: a block moves only after the blocks
/// with copies of its nodes have computed their forces.
template <class Real>
class QuadBody final : public LaidBody<QuadLayout<Real>, QuadState<Real>> {
 public:
  using BlockRange = FastBody::BlockRange;

  QuadBody(const QuadLayout<Real>& layout, bool with_damping);

  BlockRange needs(std::uint32_t block) const override {
    const QuadBlock<Real>& of = this->layout_->blocks[block];
    return {of.first_copy, of.last_copy};
  }
  std::span<const std::uint32_t> nodes(std::uint32_t block) const override;
  void set(std::uint32_t block, const MovingFrame& frame, const std::vector<Vec3>& x,
           const std::vector<Vec3>& v) override;
  void get_x(std::uint32_t block, const MovingFrame& frame, std::vector<Vec3>& x) const override;
  void get_v(std::uint32_t block, const MovingFrame& frame, std::vector<Vec3>& v) const override;
  void count_departure(Place at, bool counts) override {
    this->state_[at.block].counts[at.index] = counts ? Real(1) : Real(0);
  }
  const Box3& bounds(std::uint32_t block) const override { return this->state_[block].bounds; }
  const Vec3& largest_displacement(std::uint32_t block) const override {
    return this->state_[block].largest_displacement;
  }

  Vec3 x(Place at) const override;
  Vec3 v(Place at) const override;
  Vec3 force(Place at) const override;
  Vec3 damping_force(Place at) const override;
  void shift(Place at, const Vec3& displacement, const Vec3& kick) override;
};

}  // namespace springlod::sim
