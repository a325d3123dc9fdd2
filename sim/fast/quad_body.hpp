#pragma once

#include "sim/fast/fast_body.hpp"
#include "sim/fast/quad_state.hpp"

namespace springlod {

/// A body laid out in quads. Blocks work on copies of each other's nodes: none moves before all
/// have found their forces.
template <class Real>
class QuadBody final : public FastBody {
 public:
  /// The layout must outlive the body.
  QuadBody(const QuadLayout<Real>& layout, bool with_damping);

  std::uint32_t block_count() const override { return static_cast<std::uint32_t>(state_.size()); }
  BlockRange needs(std::uint32_t /*block*/) const override { return {0, block_count() - 1}; }
  Place place(std::uint32_t node) const override { return layout_->place[node]; }

  void set(const std::vector<Vec3>& x, const std::vector<Vec3>& v) override;
  void get(std::vector<Vec3>& x, std::vector<Vec3>& v) const override;

  void find_forces(std::uint32_t block) override { find_quad_forces(*layout_, block, state_); }
  void collect_forces(std::uint32_t block) override {
    collect_quad_forces(*layout_, block, state_);
  }
  double damping_power(std::uint32_t block) const override {
    return quad_damping_power(*layout_, block, state_);
  }
  void move(std::uint32_t block, double kick, double drift) override {
    move_quads(*layout_, block, kick, drift, state_);
  }
  const Box3& bounds(std::uint32_t block) const override { return state_[block].bounds; }

  void nodes_in(std::uint32_t block, const Box3& region,
                std::vector<std::uint32_t>& indices) const override {
    find_quad_nodes(*layout_, block, state_, region, indices);
  }

  Vec3 x(Place at) const override;
  Vec3 v(Place at) const override;
  void add_force(Place at, const Vec3& force) override;
  void add_velocity(Place at, const Vec3& more) override;

 private:
  const QuadLayout<Real>* layout_;
  QuadState<Real> state_;
};

}  // namespace springlod
