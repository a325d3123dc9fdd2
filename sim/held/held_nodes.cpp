#include "sim/held/held_nodes.hpp"

#include <algorithm>

#include "model/anchors.hpp"

namespace springlod::sim {

double end_of_paths(const std::vector<Anchor>& anchors) {
  double end = 0;
  for (const Anchor& anchor : anchors)
    if (!anchor.path.empty()) end = std::max(end, anchor.path.back().time);
  return end;
}

HeldNodes::HeldNodes(const MassSpringModel& model, const std::vector<Anchor>& anchors,
                     const std::vector<Vec3>& start, By by) {
  validate(anchors, model);
  if (!anchors.empty()) is_held_.assign(model.node_count(), 0);
  for (const Anchor& anchor : anchors) {
    const auto number = static_cast<std::uint32_t>(path_.size());
    const std::vector<std::uint8_t> flags = anchor_flags(model, anchor.nodes);
    Vec3 center = Vec3::Zero();
    double mass = 0;
    for (std::uint32_t i = 0; i < flags.size(); ++i) {
      if (flags[i] == 0) continue;
      center += model.mass[i] * start[i];
      mass += model.mass[i];
      if (anchor.spring.has_value() != (by == By::springs)) continue;
      node_.push_back(i);
      anchor_.push_back(number);
      first_.push_back(start[i]);
      is_held_[i] = 1;
    }
    path_.emplace_back(anchor.path);
    first_pivot_.push_back(anchor.pivot.value_or(Vec3(center / mass)));
  }
  pose_.resize(path_.size());
  pivot_ = first_pivot_;
  at_ = first_;
}

void HeldNodes::move_to(double time) {
  for (std::size_t a = 0; a < path_.size(); ++a) {
    if (path_[a].is_still()) continue;
    pose_[a] = path_[a].at(time);
    pivot_[a] = first_pivot_[a] + pose_[a].move;
  }
  for (std::size_t h = 0; h < node_.size(); ++h) {
    const std::size_t a = anchor_[h];
    if (!path_[a].is_still())
      at_[h] = pivot_[a] + pose_[a].rotation * (first_[h] - first_pivot_[a]);
  }
}

void HeldNodes::put(std::vector<Vec3>& x) const {
  for (std::size_t h = 0; h < node_.size(); ++h) x[node_[h]] = at_[h];
}

void HeldNodes::put_velocities(std::vector<Vec3>& v) const {
  for (std::size_t h = 0; h < node_.size(); ++h) {
    const RigidPath::Pose& pose = pose_[anchor_[h]];
    v[node_[h]] = pose.velocity + pose.spin.cross(at_[h] - pivot_[anchor_[h]]);
  }
}

}  // namespace springlod::sim
