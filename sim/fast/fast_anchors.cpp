#include "sim/fast/fast_anchors.hpp"

namespace springlod::sim {

FastAnchors::FastAnchors(const MassSpringModel& model, const Vec3& gravity, const HeldNodes& held)
    : model_(&model), gravity_(gravity), held_(&held), nodes_(held.count()) {}

void FastAnchors::start(const std::vector<Vec3>& v) {
  at_start_ = true;
  for (std::size_t h = 0; h < nodes_.size(); ++h) nodes_[h] = {.before = v[held_->node(h)]};
}

// The first kick takes half a step.
Vec3 FastAnchors::acceleration(std::size_t held, double step, const Vec3& free) const {
  return (free - nodes_[held].before) / (at_start_ ? 0.5 * step : step);
}

Vec3 FastAnchors::force(std::size_t held, double step, const Vec3& free,
                        const Vec3& velocity) const {
  const Vec3 change = at_start_ ? Vec3(Vec3::Zero()) : Vec3(velocity - nodes_[held].before);
  return model_->mass[held_->node(held)] * (change / step - acceleration(held, step, free));
}

void FastAnchors::observe(double step, const std::vector<Vec3>& x, std::vector<Vec3>& v_minus,
                          std::vector<Vec3>& v_plus) {
  for (std::size_t h = 0; h < nodes_.size(); ++h) {
    const std::uint32_t i = held_->node(h);
    const Vec3 velocity = (held_->at()[h] - x[i]) / step;
    if (at_start_)
      v_minus[i] = velocity;
    else
      nodes_[h].half_work = 0.5 * step * force(h, step, v_plus[i], velocity).dot(nodes_[h].before);
    v_plus[i] = velocity;
  }
}

void FastAnchors::book(double step, const FastCorrection& correction, AnchorForces& forces) {
  const StepNodes& nodes = correction.nodes();
  const std::vector<Vec3>& elastic = correction.forces();
  for (std::uint32_t h = 0; h < nodes_.size(); ++h) {
    Node& node = nodes_[h];
    const StepPath path = nodes.path(h);
    const Vec3 free = (path.to - path.from) / step;
    const Vec3 velocity = (held_->at()[h] - path.from) / step;
    const Vec3 pull = force(h, step, free, velocity);
    const Vec3& absorbed = nodes.absorbed()[h];
    const Vec3 moved = at_start_ ? velocity : Vec3(node.before + velocity);
    forces.add(*held_, h, step * pull - absorbed,
               0.5 * step * pull.dot(moved) - absorbed.dot(velocity));
    if (!elastic.empty()) {
      const Vec3 damping =
          model_->mass[held_->node(h)] * (acceleration(h, step, free) - gravity_) - elastic[h];
      lost_damping_ -= 0.5 * step * damping.dot(velocity - free);
    }
    node = {.before = velocity};
  }
  at_start_ = false;
}

void FastAnchors::end_step(AnchorForces& forces) {
  for (std::size_t h = 0; h < nodes_.size(); ++h) {
    forces.add(*held_, h, Vec3::Zero(), nodes_[h].half_work);
    nodes_[h].half_work = 0;
  }
}

double FastAnchors::half_work() const {
  double work = 0;
  for (const Node& node : nodes_) work += node.half_work;
  return work;
}

}  // namespace springlod::sim
