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
  void count_departures(std::span<const std::uint32_t> nodes, bool counts) override;
  const Box3& bounds(std::uint32_t block) const override { return this->state_[block].bounds; }
  const Vec3& largest_displacement(std::uint32_t block) const override {
    return this->state_[block].largest_displacement;
  }

  void get_motions(std::span<const std::uint32_t> nodes, const MovingFrame& frame,
                   std::span<NodeMotion> motions) const override;
  void get_elastic_forces(std::span<const std::uint32_t> nodes,
                          std::span<Vec3> forces) const override;
  void shift(std::span<const NodeChange> changes) override;
};

}  // namespace springlod::sim
