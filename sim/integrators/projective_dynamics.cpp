#include "sim/integrators/projective_dynamics.hpp"

#include <cmath>

namespace springlod::sim {

ProjectiveDynamics::ProjectiveDynamics(const MassSpringModel& model, const Scenario& scenario,
                                       const State& start, double step,
                                       const StepperOptions& options)
    : WholeStep(model, scenario, start, step, options),
      springs_(model, step),
      iterations_(iterations_of(options.integrator, options.solver)),
      touching_(model.node_count(), 0.0),
      free_(start.x),
      right_(static_cast<Eigen::Index>(model.node_count()), 3) {
  make_matrix();
  factor_.analyzePattern(matrix_);
}

void ProjectiveDynamics::make_matrix() {
  const auto size = static_cast<Eigen::Index>(model_->node_count());
  std::vector<Eigen::Triplet<double>> entries;
  for (std::uint32_t i = 0; i < model_->node_count(); ++i)
    entries.emplace_back(i, i, model_->mass[i] / (step_ * step_));
  for (std::uint32_t s = 0; s < model_->spring_count(); ++s) {
    const double k = springs_.stiffness(s);
    entries.emplace_back(model_->a[s], model_->a[s], k);
    entries.emplace_back(model_->b[s], model_->b[s], k);
    if (!held_.holds(model_->a[s]) && !held_.holds(model_->b[s]))
      entries.emplace_back(model_->b[s], model_->a[s], -k);
  }
  for (std::uint32_t s = 0; s < implicit_anchors_.count(); ++s)
    entries.emplace_back(implicit_anchors_.node(s), implicit_anchors_.node(s),
                         implicit_anchors_.stiffness(s));
  matrix_.resize(size, size);
  matrix_.setFromTriplets(entries.begin(), entries.end());
}

// At least the node's fraction of the stiffness of a point interpolated from several nodes: see
// contact_stiffness.
double ProjectiveDynamics::held_by(const Contact& contact,
                                   const ContactPoints::Share& share) const {
  return std::abs(share.weight) * points_.reach(contact.point) * contact.implicit_stiffness(step_);
}

void ProjectiveDynamics::take_contacts() {
  for (std::size_t i = 0; i < x_.size(); ++i) v_next_[i] = (x_next_[i] - x_[i]) / step_;
  ContactFinder finder = finder_;  // a trial must not change the side from which a node came
  finder.find(x_next_, v_next_, x_, trial_contacts_);
  std::vector<double> touching(model_->node_count(), 0.0);
  for (const Contact& c : trial_contacts_)
    for (const ContactPoints::Share& share : points_.shares(c.point))
      touching[share.node] += held_by(c, share);
  if (factorized_ && touching == touching_) return;
  touching_ = touching;
  Matrix with_contacts = matrix_;
  for (std::uint32_t i = 0; i < model_->node_count(); ++i)
    with_contacts.coeffRef(i, i) += touching_[i];
  factor_.factorize(with_contacts);
  factorized_ = true;
}

void ProjectiveDynamics::global_step() {
  for (std::uint32_t i = 0; i < model_->node_count(); ++i)
    right_.row(i) = (model_->mass[i] / (step_ * step_)) * free_[i].transpose();
  for (std::uint32_t s = 0; s < model_->spring_count(); ++s) {
    const Vec3 wanted =
        springs_.stiffness(s) * springs_.rest_length(s) * spring_axis(*model_, s, x_next_).unit;
    right_.row(model_->a[s]) -= wanted.transpose();
    right_.row(model_->b[s]) += wanted.transpose();
  }
  pull_from_held();
  for (std::uint32_t s = 0; s < implicit_anchors_.count(); ++s)
    right_.row(implicit_anchors_.node(s)) +=
        (implicit_anchors_.stiffness(s) * implicit_anchors_.place(s)).transpose();
  // A node in contact is held in place but may leave the obstacle.
  for (const Contact& c : trial_contacts_)
    for (const ContactPoints::Share& share : points_.shares(c.point))
      right_.row(share.node) +=
          (held_by(c, share) * x_next_[share.node] + share.weight * c.normal_force * c.normal)
              .transpose();
  const Columns x = factor_.solve(right_);
  for (std::uint32_t i = 0; i < model_->node_count(); ++i) x_next_[i] = x.row(i);
  held_.put(x_next_);
  spring_updates_ += model_->spring_count();
}

// The matrix leaves out what couples a node to a held one, whose position is known.
void ProjectiveDynamics::pull_from_held() {
  if (held_.empty()) return;
  for (std::uint32_t s = 0; s < model_->spring_count(); ++s) {
    const std::uint32_t a = model_->a[s];
    const std::uint32_t b = model_->b[s];
    if (held_.holds(a)) right_.row(b) += springs_.stiffness(s) * x_next_[a].transpose();
    if (held_.holds(b)) right_.row(a) += springs_.stiffness(s) * x_next_[b].transpose();
  }
}

void ProjectiveDynamics::solve() {
  springs_.begin_step(x_);
  for (std::size_t i = 0; i < x_.size(); ++i) {
    free_[i] = x_[i] + step_ * (v_[i] + step_ * gravity_);
    x_next_[i] = free_[i];
  }
  hold_nodes();
  for (std::uint32_t iteration = 0; iteration < iterations_; ++iteration) {
    take_contacts();
    global_step();
  }
  finish_implicit(springs_);
}

}  // namespace springlod::sim
