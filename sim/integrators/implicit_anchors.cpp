#include "sim/integrators/implicit_anchors.hpp"

namespace springlod::sim {

ImplicitAnchors::ImplicitAnchors(const AnchorSprings& springs, double step)
    : springs_(&springs), step_(step), steps_(springs.count()), last_places_(springs.places()) {
  for (std::uint32_t s = 0; s < count(); ++s)
    stiffness_.push_back(springs.stiffness(s) + springs.damping(s) / step);
}

void ImplicitAnchors::begin_step(const std::vector<Vec3>& x) {
  for (std::uint32_t s = 0; s < count(); ++s) {
    Step& of = steps_[s];
    of.before = last_places_[s];
    of.from = x[node(s)] - of.before;
    of.place = springs_->place(s) + springs_->damping(s) / step_ / stiffness_[s] * of.from;
  }
}

double ImplicitAnchors::energy(const std::vector<Vec3>& x) const {
  double energy = 0;
  for (std::uint32_t s = 0; s < count(); ++s)
    energy += 0.5 * stiffness_[s] * (x[node(s)] - place(s)).squaredNorm();
  return energy;
}

double ImplicitAnchors::end_step(const std::vector<Vec3>& x) {
  double loss = 0;
  for (std::uint32_t s = 0; s < count(); ++s) {
    Step& of = steps_[s];
    of.force = stiffness_[s] * (of.place - x[node(s)]);
    const Vec3 change = x[node(s)] - springs_->place(s) - of.from;
    loss += springs_->damping(s) * change.squaredNorm() / step_;
  }
  last_places_ = springs_->places();
  return loss;
}

void ImplicitAnchors::book(AnchorForces& forces) const {
  for (std::uint32_t s = 0; s < count(); ++s)
    springs_->book(s, step_, steps_[s].force, steps_[s].before, forces);
}

double ImplicitAnchors::stored(const std::vector<Vec3>& x) const {
  double energy = 0;
  for (std::uint32_t s = 0; s < count(); ++s)
    energy += 0.5 * springs_->stiffness(s) * (x[node(s)] - springs_->place(s)).squaredNorm();
  return energy;
}

}  // namespace springlod::sim
