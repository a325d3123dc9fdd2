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
  void read(std::span<const std::uint32_t> nodes, std::span<PaddedPath> paths) const override {
    motions_.resize(nodes.size());
    body_->get_motions(nodes, step_.after, motions_);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const StepPath path = path_of(motions_[i]);
      paths[i] = {padded(path.from), padded(path.to)};
    }
  }
  /// Of a node that the body does not have corrected yet.
  const StepPath& path(std::uint32_t node) const {
    Node& at = nodes_[node];
    if (at.number == step_.number) return at.path;
    NodeMotion motion;
    body_->get_motions({&node, 1}, step_.after, {&motion, 1});
    at = {step_.number, path_of(motion)};
    return at.path;
  }

 private:
  /// Read once a step: many points may share a node.
  struct Node {
    std::uint64_t number = 0;  // of the step for which it was read
    StepPath path;
  };
  StepPath path_of(const NodeMotion& end) const { return {end.x - step_.length * end.v, end.x}; }

  const FastBody* body_;
  FastStep step_;
  mutable std::vector<Node> nodes_;
  mutable std::vector<NodeMotion> motions_;  // of the last read()
};

}  // namespace springlod::sim
