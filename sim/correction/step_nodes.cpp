#include "sim/correction/step_nodes.hpp"

#include <algorithm>
#include <cmath>

namespace springlod::sim {

void StepNodes::begin(const StepPaths& paths) {
  of_step_ = &paths;
  shared_ = false;
  for (const std::uint32_t node : node_) slot_[node] = kNone;
  node_.clear();
  paths_.clear();
  at_.clear();
  seen_.clear();
  slide_.clear();
  corners_.clear();
}

std::uint32_t StepNodes::add(std::uint32_t node) {
  const auto slot = static_cast<std::uint32_t>(node_.size());
  slot_[node] = slot;
  node_.push_back(node);
  const StepPath path = of_step_->path(node);
  paths_.push_back({padded(path.from), padded(path.to)});
  at_.push_back(paths_.back().to);
  seen_.push_back(at_.back());
  slide_.emplace_back(Padded::Zero());
  corners_.emplace_back(Vec3::Zero());
  return slot;
}

double StepNodes::take_travel() {
  double most = 0;
  for (std::size_t i = 0; i < at_.size(); ++i) {
    most = std::max(most, (at_[i] - seen_[i]).squaredNorm());
    seen_[i] = at_[i];
  }
  return std::sqrt(most);
}

void StepNodes::finish(double step, std::vector<NodeChange>& changes) const {
  for (std::size_t i = 0; i < node_.size(); ++i) {
    const Vec3 displacement = this->displacement(static_cast<std::uint32_t>(i));
    changes.push_back({.node = node_[i],
                       .displacement = displacement,
                       .kick = (2 * displacement - slide_[i].head<3>()) / step,
                       .by_corners = corners_[i]});
  }
}

}  // namespace springlod::sim
