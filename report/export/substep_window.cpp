#include "report/export/substep_window.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace springlod::report {

namespace {

constexpr double kEarth = 9.81;  // [m/s2]

// In uniform stress, a spring of a material with Young's modulus E bears a force in proportion to
// k L / E, and has the energy force^2 / (2 k).
double stressed_frequency(const MassSpringModel& model) {
  double corrected = 0, compliance = 0;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const std::uint32_t a = model.a[s], b = model.b[s];
    const auto softness = [&](std::uint32_t node) {
      return 1 / model.materials[model.material[node]].young;
    };
    const double force =
        model.stiffness[s] * model.rest_length[s] * (softness(a) + softness(b)) / 2;
    corrected += force * force * (1 / model.mass[a] + 1 / model.mass[b]);
    compliance += force * force / model.stiffness[s];
  }
  return compliance > 0 ? std::sqrt(corrected / compliance) : 0;
}

// Distance of single precision numbers next to `value`.
double spacing(double value) {
  const auto single = static_cast<float>(value);
  return std::nextafter(single, std::numeric_limits<float>::infinity()) - single;
}

// 20 substeps in each of 60 frames, which a game can pay.
constexpr int kCheapRate = 1200;

double softening(double frequency, double rate) {
  return kSweepError * frequency * frequency / (rate * rate);
}

// Error = sweep / rate^2 + rounding rate^2.
struct ErrorTerms {
  double frequency = 0, sweep = 0, rounding = 0;
  double at(double rate) const { return sweep / (rate * rate) + rounding * rate * rate; }
};

ErrorTerms error_terms(const MassSpringModel& model, double gravity, double extent) {
  const double frequency = stressed_frequency(model);
  const double pull = gravity > 0 ? gravity : kEarth;
  return {.frequency = frequency,
          .sweep = softening(frequency, 1),
          .rounding = kRoundingError * spacing(extent) / pull};
}

// Squares of the rates between which the error is at most `bound`; nothing if it never is.
struct Range {
  double from = 0, to = 0;
};
Range squares_within(const ErrorTerms& terms, double bound) {
  const double discriminant = bound * bound - 4 * terms.sweep * terms.rounding;
  if (discriminant < 0) return {};
  const double upper = (bound + std::sqrt(discriminant)) / (2 * terms.rounding);
  // The product of both is sweep / rounding; their difference would cancel.
  return {.from = terms.sweep / terms.rounding / upper, .to = upper};
}

}  // namespace

SubstepWindow substep_window(const MassSpringModel& model, double gravity, double extent) {
  const ErrorTerms terms = error_terms(model, gravity, extent);
  SubstepWindow window{.frequency = terms.frequency};
  const Range within = squares_within(terms, kWindowError);
  window.from = std::sqrt(within.from);
  window.to = std::sqrt(within.to);
  const Range good = squares_within(terms, kGoodError);
  window.rate = good.to > 0 ? std::sqrt(good.from) : std::pow(terms.sweep / terms.rounding, 0.25);
  window.rate = std::max<double>(window.rate, FrameSubsteps::kFrames);
  window.error = terms.at(window.rate);
  return window;
}

FrameSubsteps frame_substeps(const SubstepWindow& window) {
  return {static_cast<int>(std::ceil(window.rate / FrameSubsteps::kFrames))};
}

std::vector<std::string> describe_window(const SubstepWindow& window) {
  if (!window.empty())
    return {fmt::format(
        "within {:.0f} % at rest from {:.0f} to {:.0f} substeps a second: fewer leave the springs "
        "unsolved, with more single precision loses gravity",
        100 * kWindowError, window.from, window.to)};
  return {
      fmt::format("no rate keeps the static deformation within {:.0f} %: fewer substeps leave "
                  "the springs unsolved, with more single precision loses gravity; this is the "
                  "best, with an error of up to {:.2g} %",
                  100 * kWindowError, 100 * window.error),
      fmt::format("a coarser level or softer materials need fewer substeps; {} a second make the "
                  "body up to {:.2g} times as soft, which may not show in a stiff one",
                  kCheapRate, 1 + softening(window.frequency, kCheapRate))};
}

}  // namespace springlod::report
