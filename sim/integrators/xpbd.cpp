#include "sim/integrators/xpbd.hpp"

#include <algorithm>

namespace springlod::sim {

Xpbd::Xpbd(const MassSpringModel& model, const Scenario& scenario, const State& start, double step,
           const StepperOptions& options)
    : WholeStep(model, scenario, start, step, options),
      springs_(model, step),
      sweeps_(iterations_of(options.integrator, options.solver)),
      multiplier_(model.spring_count()) {
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    inverse_mass_.push_back(held_.holds(i) ? 0 : 1 / model.mass[i]);
}

void Xpbd::sweep_springs() {
  const double step_squared = step_ * step_;
  for (std::uint32_t s = 0; s < model_->spring_count(); ++s) {
    const double k = springs_.stiffness(s);
    if (!(k > 0)) continue;
    const std::uint32_t a = model_->a[s];
    const std::uint32_t b = model_->b[s];
    const auto [unit, length] = spring_axis(*model_, s, x_next_);
    const double compliance = 1 / (k * step_squared);
    const double error = length - springs_.rest_length(s);
    const double change =
        (-error - compliance * multiplier_[s]) / (inverse_mass_[a] + inverse_mass_[b] + compliance);
    multiplier_[s] += change;
    x_next_[a] -= inverse_mass_[a] * change * unit;
    x_next_[b] += inverse_mass_[b] * change * unit;
  }
  spring_updates_ += model_->spring_count();
}

void Xpbd::sweep_anchors() {
  for (std::uint32_t s = 0; s < implicit_anchors_.count(); ++s) {
    const std::uint32_t i = implicit_anchors_.node(s);
    const double compliance = 1 / (implicit_anchors_.stiffness(s) * step_ * step_);
    const Vec3 error = x_next_[i] - implicit_anchors_.place(s);
    const Vec3 change =
        (-error - compliance * anchor_multiplier_[s]) / (inverse_mass_[i] + compliance);
    anchor_multiplier_[s] += change;
    x_next_[i] += inverse_mass_[i] * change;
  }
}

void Xpbd::sweep_contacts() {
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const Contact& c = candidates_[i];
    // Depth minus the depth that damping alone would balance, along the normal at which the contact
    // was found.
    const double stiffness = c.implicit_stiffness(step_);
    const double depth = c.normal_force / stiffness -
                         c.normal.dot(points_.interpolate(c.point, x_next_) - found_at_[i]);
    const double compliance = 1 / (stiffness * step_ * step_);
    const double inverse_mass = 1 / points_.mass(c.point);
    const double wanted =
        (depth - compliance * contact_multiplier_[i]) / (inverse_mass + compliance);
    const double change = std::max(wanted, -contact_multiplier_[i]);  // it never pulls
    contact_multiplier_[i] += change;
    points_.kick(c.point, inverse_mass * change * c.normal, x_next_);
  }
}

void Xpbd::solve() {
  springs_.begin_step(x_);
  std::fill(multiplier_.begin(), multiplier_.end(), 0.0);
  for (std::size_t i = 0; i < x_.size(); ++i) {
    v_next_[i] = v_[i] + step_ * gravity_;
    x_next_[i] = x_[i] + step_ * v_next_[i];
  }
  hold_nodes();
  finder_.find(x_next_, v_next_, x_, candidates_);
  found_at_.clear();
  for (const Contact& c : candidates_) found_at_.push_back(points_.interpolate(c.point, x_next_));
  contact_multiplier_.assign(candidates_.size(), 0.0);
  anchor_multiplier_.assign(implicit_anchors_.count(), Vec3::Zero());
  for (std::uint32_t sweep = 0; sweep < sweeps_; ++sweep) {
    sweep_springs();
    sweep_anchors();
    sweep_contacts();
  }
  finish_implicit(springs_);
}

}  // namespace springlod::sim
