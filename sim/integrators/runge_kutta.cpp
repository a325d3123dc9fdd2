#include "sim/integrators/runge_kutta.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>

#include "sim/integrators/kernel.hpp"

namespace springlod::sim {
namespace {

using Complex = std::complex<double>;

// Stability limit along the direction `lambda`: largest t with |R(lambda t)| <= 1. In the left half
// plane, the stability region is star-shaped about 0, and it lies within |z| < 4.
double reach(const Complex& lambda) {
  constexpr double kSlack = 1e-12;  // |R| = 1 - O(z^6) on the imaginary axis: rounding would decide
  const auto stable = [&](double t) {
    const Complex z = lambda * t;
    return std::abs(1. + z * (1. + z / 2. * (1. + z / 3. * (1. + z / 4.)))) <= 1 + kSlack;
  };
  double low = 0;
  double high = 4 / std::abs(lambda);
  constexpr int kHalvings = 40;  // to 1 part in 1e12
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (low + high) / 2;
    (stable(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace

double runge_kutta_stable_step(double omega_max, double damping_time) {
  if (!(omega_max > 0)) return std::numeric_limits<double>::infinity();
  constexpr int kFrequencies = 64;  // the limit is smooth in omega and nearly always at omega_max
  double least = std::numeric_limits<double>::infinity();
  for (int i = 1; i <= kFrequencies; ++i) {
    const double omega = omega_max * i / kFrequencies;
    const double half = damping_time * omega * omega / 2;
    const Complex root = std::sqrt(Complex(half * half - omega * omega));
    least = std::min({least, reach(-half + root), reach(-half - root)});
  }
  return least;
}

RungeKutta::RungeKutta(const MassSpringModel& model, const Scenario& scenario, const State& start,
                       double step, const StepperOptions& options)
    : WholeStep(model, scenario, start, step, options),
      x_stage_(start.x.size()),
      v_stage_(start.x.size()),
      acceleration_(start.x.size()),
      damping_force_(start.x.size()),
      held_force_(held_.count()),
      held_velocity_(held_.count()) {}

double RungeKutta::accelerate(const std::vector<Vec3>& x, const std::vector<Vec3>& v,
                              std::vector<Vec3>& a) {
  std::fill(a.begin(), a.end(), Vec3::Zero());
  double power = 0;
  if (with_ledger_) {
    std::fill(damping_force_.begin(), damping_force_.end(), Vec3::Zero());
    add_internal_forces<true>(*model_, x, v, a, damping_force_);
    for (std::size_t i = 0; i < x.size(); ++i) power -= damping_force_[i].dot(v[i]);
  } else {
    add_internal_forces<false>(*model_, x, v, a, damping_force_);
  }
  for (std::uint32_t h = 0; h < held_.count(); ++h) {
    held_force_[h] = a[held_.node(h)];
    held_velocity_[h] = v[held_.node(h)];
  }
  for (std::size_t i = 0; i < x.size(); ++i) a[i] = a[i] / model_->mass[i] + gravity_;
  spring_updates_ += model_->spring_count();
  return power;
}

void RungeKutta::solve() {
  struct Stage {
    double at;      // where the next stage is evaluated [steps]
    double weight;  // weight of this stage in the sum [1]
  };
  constexpr std::array<Stage, 4> kStages{{{0.5, 1. / 6}, {0.5, 1. / 3}, {1, 1. / 3}, {0, 1. / 6}}};
  x_stage_ = x_;
  v_stage_ = v_;
  x_next_ = x_;
  v_next_ = v_;
  std::fill(anchor_steps_.begin(), anchor_steps_.end(), AnchorStep{});
  for (const Stage& stage : kStages) {
    lost_damping_ += step_ * stage.weight * accelerate(x_stage_, v_stage_, acceleration_);
    for (std::size_t i = 0; i < x_.size(); ++i) {
      x_next_[i] += step_ * stage.weight * v_stage_[i];
      v_next_[i] += step_ * stage.weight * acceleration_[i];
      x_stage_[i] = x_[i] + step_ * stage.at * v_stage_[i];
      v_stage_[i] = v_[i] + step_ * stage.at * acceleration_[i];
    }
    hold_stage(stage.weight, stage.at);
  }
  finish_held();
}

// The forces of the anchors follow from the motion of their nodes and the forces on these: less
// the latter over the step, by its quadrature, here.
void RungeKutta::hold_stage(double weight, double next) {
  for (std::uint32_t h = 0; h < held_.count(); ++h) {
    const Vec3 impulse = step_ * weight * held_force_[h];
    anchor_steps_[h].impulse -= impulse;
    anchor_steps_[h].work -= impulse.dot(held_velocity_[h]);
  }
  held_.move_to(time() + next * step_);
  held_.put(x_stage_);
  held_.put_velocities(v_stage_);
}

void RungeKutta::finish_held() {
  hold_nodes();
  held_.put_velocities(v_next_);
  for (std::uint32_t h = 0; h < held_.count(); ++h) {
    const std::uint32_t i = held_.node(h);
    const double mass = model_->mass[i];
    anchor_steps_[h].impulse += mass * (v_next_[i] - v_[i] - step_ * gravity_);
    anchor_steps_[h].work += mass * (0.5 * (v_next_[i].squaredNorm() - v_[i].squaredNorm()) -
                                     gravity_.dot(x_next_[i] - x_[i]));
  }
}

}  // namespace springlod::sim
