#pragma once

#include "sim/fast/laid_body.hpp"
#include "sim/fast/quad_state.hpp"

namespace springlod {

/// A body laid out in quads. Blocks work on copies of each other's nodes: none moves before all
/// have found their forces.
template <class Real>
class QuadBody final : public LaidBody<QuadLayout<Real>, QuadState<Real>> {
 public:
  using BlockRange = FastBody::BlockRange;

  QuadBody(const QuadLayout<Real>& layout, bool with_damping);

  BlockRange needs(std::uint32_t /*block*/) const override { return {0, this->block_count() - 1}; }
  void set(const std::vector<Vec3>& x, const std::vector<Vec3>& v) override;
  void get_x(std::vector<Vec3>& x) const override;
  void get_v(std::vector<Vec3>& v) const override;
  const Box3& bounds(std::uint32_t block) const override { return this->state_[block].bounds; }

  Vec3 x(Place at) const override;
  Vec3 v(Place at) const override;
  void add_force(Place at, const Vec3& force) override;
  void add_velocity(Place at, const Vec3& more) override;
};

}  // namespace springlod
