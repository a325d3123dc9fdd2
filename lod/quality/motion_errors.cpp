#include "lod/quality/motion_errors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lod/group_means.hpp"

namespace springlod::lod {
namespace {

// Times in the first period at which displacements are compared.
constexpr int kSamples = 24;

std::size_t motion_count(const ModalMotion& motion) {
  return std::min({kLowestModes, motion.base_modes.size(), motion.shapes.size()});
}

/// A free vibration of the level in its own modes.
struct Vibration {
  const std::vector<elastic::Mode>& modes;
  std::vector<double> velocities;  ///< of the modes at t = 0 [m/s kg^1/2]

  double amplitude(std::size_t mode, double t) const {
    const double omega = modes[mode].angular_frequency;
    return velocities[mode] * std::sin(omega * t) / omega;
  }
};

}  // namespace

double mass_product(const std::vector<double>& mass, const std::vector<Vec3>& x,
                    const std::vector<Vec3>& y) {
  double sum = 0;
  for (std::size_t i = 0; i < mass.size(); ++i) sum += mass[i] * x[i].dot(y[i]);
  return sum;
}

double blow_error(const ModalMotion& motion) {
  const std::vector<double> mass = group_masses(motion.base.mass, motion.level.of_base);
  double error = 0;
  double size = 0;
  for (std::size_t i = 0; i < motion_count(motion); ++i)
    for (std::size_t g = 0; g < mass.size(); ++g) {
      const double square = mass[g] * motion.shapes[i][g].squaredNorm();
      const double ratio = mass[g] / motion.level.model.mass[g] - 1;  // of velocities
      error += ratio * ratio * square;
      size += square;
    }
  return size > 0 ? std::sqrt(error / size) : 0;
}

// |P phi - sum a_j phi_j|^2 needs the products of the shapes alone: the level's modes are
// orthonormal.
double first_period_error(const ModalMotion& motion) {
  const std::vector<double>& mass = motion.level.model.mass;
  double error = 0;
  double size = 0;
  for (std::size_t i = 0; i < motion_count(motion); ++i) {
    const std::vector<Vec3>& shape = motion.shapes[i];
    Vibration level{motion.level_modes, {}};
    for (const elastic::Mode& mode : motion.level_modes)
      level.velocities.push_back(mass_product(mass, mode.shape, shape));
    const double square = mass_product(mass, shape, shape);
    const double omega = motion.base_modes[i].angular_frequency;
    for (int k = 1; k <= kSamples; ++k) {
      const double t =
          2 * std::numbers::pi / motion.base_modes.front().angular_frequency * k / kSamples;
      const double wanted = std::sin(omega * t) / omega;
      error += wanted * wanted * square;
      for (std::size_t j = 0; j < motion.level_modes.size(); ++j) {
        const double amplitude = level.amplitude(j, t);
        error += amplitude * (amplitude - 2 * wanted * level.velocities[j]);
      }
      size += wanted * wanted * square;
    }
  }
  return size > 0 ? std::sqrt(std::max(0.0, error) / size) : 0;
}

double decay_rate(const MassSpringModel& model, const elastic::Mode& mode) {
  double power = 0;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const double rate =
        spring_direction(model, s).dot(mode.shape[model.b[s]] - mode.shape[model.a[s]]);
    power += model.damping[s] * rate * rate;
  }
  const DilatationTerms& terms = model.dilatation;
  for (std::uint32_t t = 0; t < terms.count(); ++t) {
    const double rate = linear_dilatation(terms, t, mode.shape);
    power += terms.damping_time[t] * terms.modulus[t] * rate * rate;
  }
  return power / 2;  // shapes are mass-normalised
}

}  // namespace springlod::lod
