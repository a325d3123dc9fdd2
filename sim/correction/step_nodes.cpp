#include "sim/correction/step_nodes.hpp"

#include <algorithm>
#include <cmath>

namespace springlod::sim {

StepNodes::StepNodes(std::uint32_t node_count, const HeldNodes* held,
                     const std::vector<std::uint32_t>& on_springs)
    : held_(held), by_spring_(on_springs.size(), Vec3::Zero()), slot_(node_count, kNone) {
  if (held != nullptr) node_ = held->nodes();
  held_count_ = count();
  node_.insert(node_.end(), on_springs.begin(), on_springs.end());
  for (std::uint32_t slot = 0; slot < count(); ++slot) slot_[node_[slot]] = slot;
  keep_none();
}

void StepNodes::begin(const StepPaths& paths) {
  of_step_ = &paths;
  shared_ = kept_shared_;
  for (std::uint32_t slot = kept_; slot < count(); ++slot) slot_[node_[slot]] = kNone;
  node_.resize(kept_);
  paths_.resize(kept_);
  paths.read(node_, paths_);
  at_.clear();
  for (const PaddedPath& path : paths_) at_.push_back(path.to);
  for (std::uint32_t slot = 0; slot < held_count_; ++slot) at_[slot] = padded(held_->at()[slot]);
  absorbed_.assign(held_count_, Vec3::Zero());
  seen_ = at_;
  slide_.assign(kept_, Padded::Zero());
  corners_.assign(kept_, Vec3::Zero());
}

void StepNodes::keep() {
  kept_ = count();
  kept_shared_ = shared_;
}

void StepNodes::keep_none() {
  kept_ = held_count_ + static_cast<std::uint32_t>(by_spring_.size());
  kept_shared_ = false;
}

std::uint32_t StepNodes::add(std::uint32_t node) {
  const auto slot = static_cast<std::uint32_t>(node_.size());
  slot_[node] = slot;
  node_.push_back(node);
  of_step_->read({&node, 1}, {&paths_.emplace_back(), 1});
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
  const std::size_t first = changes.size() + held_count_;
  for (std::size_t i = 0; i < node_.size(); ++i) {
    const Padded displacement = at_[i] - paths_[i].to;
    const Padded& slide = is_held(static_cast<std::uint32_t>(i)) ? displacement : slide_[i];
    const Padded kick = (2 * displacement - slide) / step;
    changes.push_back({.node = node_[i],
                       .displacement = displacement.head<3>(),
                       .kick = kick.head<3>(),
                       .by_corners = corners_[i]});
  }
  for (std::size_t s = 0; s < by_spring_.size(); ++s) changes[first + s].by_spring = by_spring_[s];
}

}  // namespace springlod::sim
