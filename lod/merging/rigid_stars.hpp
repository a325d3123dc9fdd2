#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "model/mass_spring.hpp"
#include "model/vec.hpp"

namespace springlod::lod {

/// A graph of nodes and springs in which springs can be fused, and the test of its stars. A star is
/// a node with its neighbours and all springs among them. If every star is rigid, so is each
/// connected component: the stars of two joined nodes share these and a third node off their line,
/// hence they move as one body. The test is local, so it is cheap after each fusion.
class RigidStars {
 public:
  /// `tension`: k L of each spring [N]; fusing conserves it.
  explicit RigidStars(const MassSpringModel& model);

  struct Link {
    std::uint32_t node;
    double tension;  ///< sum of k L of the fused springs [N]
  };

  std::uint32_t size() const { return static_cast<std::uint32_t>(links_.size()); }
  const std::vector<Link>& links(std::uint32_t i) const { return links_[i]; }  ///< sorted by node
  double mass(std::uint32_t i) const { return mass_[i]; }
  const Vec3& center(std::uint32_t i) const { return center_[i]; }

  /// Whether the star of `i` is surely rigid: it grows from a triangle at `i` by nodes with springs
  /// in three independent directions. Other rigid stars exist and are not recognised.
  bool rigid(std::uint32_t i);

  /// What a fusion replaced, for undo.
  struct Before {
    std::uint32_t kept, gone;
    double mass;
    Vec3 center;
    std::vector<std::pair<std::uint32_t, std::vector<Link>>> links;
  };
  /// Fuses `gone` into `kept`, which then lies at their centre of mass. `gone` has no links left.
  Before fuse(std::uint32_t kept, std::uint32_t gone);
  void undo(Before before);

 private:
  bool grows_from(std::uint32_t i, std::uint32_t j, std::uint32_t k);
  bool placed(std::uint32_t i) const { return placed_at_[i] == now_; }

  std::vector<double> mass_;  // [kg]
  std::vector<Vec3> center_;  // [m]
  std::vector<std::vector<Link>> links_;
  std::vector<std::uint64_t> placed_at_;  // the growth that placed a node last
  std::uint64_t now_ = 0;
};

}  // namespace springlod::lod
