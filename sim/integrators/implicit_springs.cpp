#include "sim/integrators/implicit_springs.hpp"

namespace springlod::sim {

ImplicitSprings::ImplicitSprings(const MassSpringModel& model, double step)
    : model_(&model), step_(step), rest_length_(model.rest_length) {
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    stiffness_.push_back(model.stiffness[s] + model.damping[s] / step);
  start_length_ = rest_length_;
}

void ImplicitSprings::begin_step(const std::vector<Vec3>& x) {
  for (std::uint32_t s = 0; s < model_->spring_count(); ++s) {
    start_length_[s] = (x[model_->b[s]] - x[model_->a[s]]).norm();
    if (stiffness_[s] > 0)
      rest_length_[s] = (model_->stiffness[s] * model_->rest_length[s] +
                         model_->damping[s] / step_ * start_length_[s]) /
                        stiffness_[s];
  }
}

double ImplicitSprings::energy(const std::vector<Vec3>& x) const {
  double energy = 0;
  for (std::uint32_t s = 0; s < model_->spring_count(); ++s) {
    const double stretch = (x[model_->b[s]] - x[model_->a[s]]).norm() - rest_length_[s];
    energy += 0.5 * stiffness_[s] * stretch * stretch;
  }
  return energy;
}

double ImplicitSprings::damping_loss(const std::vector<Vec3>& x) const {
  double loss = 0;
  for (std::uint32_t s = 0; s < model_->spring_count(); ++s) {
    const double change = (x[model_->b[s]] - x[model_->a[s]]).norm() - start_length_[s];
    loss += model_->damping[s] * change * change / step_;
  }
  return loss;
}

SpringAxis spring_axis(const MassSpringModel& model, std::uint32_t spring,
                       const std::vector<Vec3>& x) {
  const Vec3 along = x[model.b[spring]] - x[model.a[spring]];
  const double length = along.norm();
  return {length > 0 ? Vec3(along / length) : Vec3(Vec3::UnitX()), length};
}

}  // namespace springlod::sim
