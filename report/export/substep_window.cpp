#include "report/export/substep_window.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace springlod::report {

namespace {

constexpr double kEarth = 9.81;  // [m/s2]

// 20 substeps in each of 60 frames, which a game can pay.
constexpr int kCheapRate = 1200;

// Distance of single precision numbers next to `value`.
double spacing(double value) {
  const auto single = static_cast<float>(value);
  return std::nextafter(single, std::numeric_limits<float>::infinity()) - single;
}

// Relative error of the static deformation over the rate of substeps.
class StaticError {
 public:
  StaticError(const MassSpringModel& model, double gravity, double extent)
      : rounding_(kRoundingError * spacing(extent) / (gravity > 0 ? gravity : kEarth)) {
    // In uniform stress, a spring of a material with Young's modulus E bears a force in proportion
    // to k L / E, and has the energy force^2 / (2 k).
    double energy = 0;
    for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
      const std::uint32_t a = model.a[s], b = model.b[s];
      const auto softness = [&](std::uint32_t node) {
        return 1 / model.materials[model.material[node]].young;
      };
      const double stretch = model.rest_length[s] * (softness(a) + softness(b)) / 2;
      const double k = model.stiffness[s];
      springs_.push_back({k * stretch * stretch, k * (1 / model.mass[a] + 1 / model.mass[b])});
      energy += springs_.back().energy;
    }
    for (Spring& spring : springs_) {
      spring.energy /= energy;
      square_frequency_ += spring.energy * spring.square_frequency;
    }
  }

  double frequency() const { return std::sqrt(square_frequency_); }

  // Grows as the rate falls.
  double of_sweeps(double rate) const {
    const double square_step = 1 / (rate * rate);
    double error = kOrderError * square_frequency_ * square_step;
    for (const Spring& spring : springs_)
      error += spring.energy * std::max(spring.square_frequency * square_step / 2 - 1, 0.0);
    return error;
  }
  // Convex over the square of the step, so that it has one minimum.
  double at(double rate) const { return of_sweeps(rate) + rounding_ * rate * rate; }

 private:
  struct Spring {
    double energy;            // fraction of the body's
    double square_frequency;  // k (1/m_a + 1/m_b)
  };
  std::vector<Spring> springs_;
  double square_frequency_ = 0;
  double rounding_;
};

constexpr double kLeastRate = 1, kLargestRate = 1e9;  // [1/s]

// Rate of the least error, by golden section.
double best_rate(const StaticError& error) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double from = std::log(kLeastRate), to = std::log(kLargestRate);
  while (to - from > 1e-4) {
    const double low = to - golden * (to - from), high = from + golden * (to - from);
    if (error.at(std::exp(low)) <= error.at(std::exp(high)))
      to = high;
    else
      from = low;
  }
  return std::exp((from + to) / 2);
}

// Rate with an error of `bound` between one within it and one outside.
double rate_of(const StaticError& error, double bound, double within, double outside) {
  while (std::abs(outside / within - 1) > 1e-6) {
    const double middle = std::sqrt(within * outside);
    (error.at(middle) <= bound ? within : outside) = middle;
  }
  return within;
}

}  // namespace

SubstepWindow substep_window(const MassSpringModel& model, double gravity, double extent) {
  const StaticError error(model, gravity, extent);
  SubstepWindow window{.frequency = error.frequency()};
  const double best = best_rate(error), least = error.at(best);
  if (least <= kWindowError) {
    window.from = rate_of(error, kWindowError, best, kLeastRate);
    window.to = rate_of(error, kWindowError, best, kLargestRate);
  }
  window.rate = least <= kGoodError ? rate_of(error, kGoodError, best, kLeastRate) : best;
  window.rate = std::max<double>(window.rate, FrameSubsteps::kFrames);
  window.error = error.at(window.rate);
  window.cheap_softening = 1 + error.of_sweeps(kCheapRate);
  return window;
}

FrameSubsteps frame_substeps(const SubstepWindow& window) {
  return {static_cast<int>(std::ceil(window.rate / FrameSubsteps::kFrames))};
}

std::vector<std::string> describe_window(const SubstepWindow& window) {
  const std::string why =
      "fewer substeps leave the springs unsolved, with more single precision loses gravity";
  if (!window.empty())
    return {
        fmt::format("static deformation: expect an error of up to {:.2g} %; at most {:.0f} % "
                    "from {:.0f} to {:.0f} substeps a second: {}",
                    100 * window.error, 100 * kWindowError, window.from, window.to, why)};
  return {
      fmt::format("static deformation: expect an error of up to {:.2g} %, the least of all rates: "
                  "{}",
                  100 * window.error, why),
      fmt::format("cells of twice the size or a quarter of Young's modulus halve that error, a "
                  "coarser level reduces it; {} substeps a second make the body up to {:.2g} times "
                  "as soft, which may not show in a stiff one",
                  kCheapRate, window.cheap_softening)};
}

}  // namespace springlod::report
