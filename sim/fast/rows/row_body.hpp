#pragma once

#include "sim/fast/laid_body.hpp"
#include "sim/fast/rows/row_state.hpp"

namespace springlod::sim {

/// A body in rows. Springs end only at later places, so a block can move when the blocks up to it
/// have computed their forces.
template <class Real>
class RowBody final : public LaidBody<RowLayout<Real>, RowState<Real>> {
 public:
  using BlockRange = FastBody::BlockRange;

  RowBody(const RowLayout<Real>& layout, bool with_damping)
      : LaidBody<RowLayout<Real>, RowState<Real>>(layout, RowState<Real>(layout, with_damping),
                                                  row_kernels<Real>()) {}

  BlockRange needs(std::uint32_t block) const override {
    return {this->layout_->first_contributor(block), block};
  }
  std::span<const std::uint32_t> nodes(std::uint32_t block) const override;
  void set(std::uint32_t block, const MovingFrame& frame, const std::vector<Vec3>& x,
           const std::vector<Vec3>& v) override;
  void get_x(std::uint32_t block, const MovingFrame& frame, std::vector<Vec3>& x) const override;
  void get_v(std::uint32_t block, const MovingFrame& frame, std::vector<Vec3>& v) const override;
  void count_departures(std::span<const std::uint32_t> nodes, bool counts) override;
  const Box3& bounds(std::uint32_t block) const override { return this->state_.bounds[block]; }
  const Vec3& largest_displacement(std::uint32_t block) const override {
    return this->state_.largest_displacement[block];
  }

  void get_motions(std::span<const std::uint32_t> nodes, const MovingFrame& frame,
                   std::span<NodeMotion> motions) const override;
  void get_elastic_forces(std::span<const std::uint32_t> nodes,
                          std::span<Vec3> forces) const override;
  void shift(std::span<const NodeChange> changes) override;

 private:
  /// Number of a place, counted from the first of the body.
  std::uint32_t position(Place at) const {
    return this->layout_->blocks[at.block].first + at.index;
  }
};

}  // namespace springlod::sim
