#include "sim/held/step_springs.hpp"

#include <algorithm>
#include <cmath>

namespace springlod::sim {

StepSprings::StepSprings(const AnchorSprings* springs) : springs_(springs) {
  if (empty()) return;
  pulls_.resize(springs_->count());
  last_places_ = springs_->places();
}

void StepSprings::begin(double step, StepNodes& nodes) {
  loss_ = 0;
  if (empty()) return;
  step_ = step;
  for (std::uint32_t s = 0; s < pulls_.size(); ++s) {
    Pull& pull = pulls_[s];
    const std::uint32_t slot = nodes.slot_on_spring(s);
    const double elastic = springs_->stiffness(s) / 2;
    const double viscous = springs_->damping(s) / step;
    pull.before = last_places_[s];
    pull.from = nodes.path(slot).from - pull.before;
    pull.mobility = step * step / (2 * springs_->mass(s));
    pull.early = elastic - viscous;
    pull.late = elastic + viscous;
    nodes.move(slot, pull.mobility * pull.force);
  }
}

double StepSprings::sweep(StepNodes& nodes) {
  double largest_change = 0;
  double largest = 0;
  for (std::uint32_t s = 0; s < pulls_.size(); ++s) {
    Pull& pull = pulls_[s];
    const std::uint32_t slot = nodes.slot_on_spring(s);
    const Vec3 free = nodes.at(slot) - pull.mobility * pull.force - springs_->place(s);
    const Vec3 force =
        -(pull.early * pull.from + pull.late * free) / (1 + pull.mobility * pull.late);
    const Vec3 change = pull.mobility * (force - pull.force);
    pull.force = force;
    nodes.move(slot, change);
    largest_change = std::max(largest_change, change.squaredNorm());
    largest = std::max(largest, (pull.mobility * force).squaredNorm());
  }
  return largest > 0 ? std::sqrt(largest_change / largest) : 0;
}

void StepSprings::finish(StepNodes& nodes) {
  if (empty()) return;
  double energy = 0;
  for (std::uint32_t s = 0; s < pulls_.size(); ++s) {
    const Pull& pull = pulls_[s];
    const std::uint32_t slot = nodes.slot_on_spring(s);
    const Vec3 to = nodes.at(slot) - springs_->place(s);
    energy += 0.5 * springs_->stiffness(s) * to.squaredNorm();
    loss_ -= pull.force.dot(to - pull.from);
    nodes.set_by_spring(s, pull.mobility * pull.force);
  }
  loss_ -= energy - energy_;
  energy_ = energy;
  last_places_ = springs_->places();
}

void StepSprings::book(AnchorForces& forces) const {
  for (std::size_t s = 0; s < pulls_.size(); ++s)
    springs_->book(s, step_, pulls_[s].force, pulls_[s].before, forces);
}

}  // namespace springlod::sim
