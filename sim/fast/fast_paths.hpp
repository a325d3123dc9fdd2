#pragma once

#include <cstdint>
#include <vector>

#include "sim/correction/step_nodes.hpp"
#include "sim/fast/fast_body.hpp"

namespace springlod::sim {

/// One drift of a fast body.
struct FastStep {
  std::uint64_t number = 0;  ///< of the step at its end
  MovingFrame before, after;
  double length = 0;  ///< dt [s]
};

/// The paths of the nodes of a fast body in its last drift, in world axes.
class FastPaths final : public StepPaths {
 public:
  FastPaths(const FastBody& body, std::uint32_t node_count) : body_(&body), nodes_(node_count) {}

  /// `step`: the drift that the body has just done.
  void begin(const FastStep& step) { step_ = step; }
  StepPath path(std::uint32_t node) const override { return read(node).path; }
  const Vec3& to(std::uint32_t node) const { return read(node).path.to; }
  /// Changes the end of the path of a node.
  void shift(std::uint32_t node, const Vec3& displacement) {
    read(node);
    nodes_[node].path.to += displacement;
  }

 private:
  /// Read once a step: many points may share a node.
  struct Node {
    std::uint64_t number = 0;  // of the step for which it was read
    StepPath path;
  };
  const Node& read(std::uint32_t node) const {
    Node& at = nodes_[node];
    if (at.number == step_.number) return at;
    const Place place = body_->place(node);
    at.number = step_.number;
    at.path.to = step_.after.origin + body_->x(place);
    at.path.from = at.path.to - step_.length * (step_.after.velocity + body_->v(place));
    return at;
  }

  const FastBody* body_;
  FastStep step_;
  mutable std::vector<Node> nodes_;
};

}  // namespace springlod::sim
