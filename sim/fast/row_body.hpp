#pragma once

#include "sim/fast/fast_body.hpp"
#include "sim/fast/row_state.hpp"

namespace springlod {

/// A body laid out in rows. Springs lead ahead only: a block moves as soon as those up to it have
/// found their forces.
template <class Real>
class RowBody final : public FastBody {
 public:
  /// The layout must outlive the body.
  RowBody(const RowLayout<Real>& layout, bool with_damping)
      : layout_(&layout), state_(layout, with_damping) {}

  std::uint32_t block_count() const override {
    return static_cast<std::uint32_t>(layout_->blocks.size());
  }
  BlockRange needs(std::uint32_t block) const override {
    return {layout_->first_contributor(block), block};
  }
  Place place(std::uint32_t node) const override { return layout_->place[node]; }

  void set(const std::vector<Vec3>& x, const std::vector<Vec3>& v) override;
  void get(std::vector<Vec3>& x, std::vector<Vec3>& v) const override;

  void find_forces(std::uint32_t block) override { find_row_forces(*layout_, block, state_); }
  void collect_forces(std::uint32_t block) override { collect_row_forces(*layout_, block, state_); }
  double damping_power(std::uint32_t block) const override {
    return row_damping_power(*layout_, block, state_);
  }
  void move(std::uint32_t block, double kick, double drift) override {
    move_rows(*layout_, block, kick, drift, state_);
  }
  const Box3& bounds(std::uint32_t block) const override { return state_.bounds[block]; }

  void nodes_in(std::uint32_t block, const Box3& region,
                std::vector<std::uint32_t>& indices) const override {
    find_row_nodes(*layout_, block, state_, region, indices);
  }

  Vec3 x(Place at) const override;
  Vec3 v(Place at) const override;
  void add_force(Place at, const Vec3& force) override;
  void add_velocity(Place at, const Vec3& more) override;

 private:
  std::uint32_t position(Place at) const { return layout_->blocks[at.block].first + at.index; }

  const RowLayout<Real>* layout_;
  RowState<Real> state_;
};

}  // namespace springlod
