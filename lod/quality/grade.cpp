#include "lod/quality/grade.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

namespace springlod::lod {
namespace {

/// Largest errors of a good and of a fair level [1].
struct Bounds {
  double good, fair;
};
// Of the levels that are fitted to the nine bodies of `springlod fit`, with 45 and 20 % of their
// nodes, all but one are within those of fair levels.
constexpr Bounds kFrequencies{0.01, 0.03};
constexpr Bounds kImpacts{0.03, 0.1};
constexpr Bounds kFirstPeriod{0.2, 0.4};
constexpr Bounds kLocalLoads{0.08, 0.2};
// Young's modulus over the base's, or its inverse, minus 1.
constexpr Bounds kModulus{0.25, 0.75};

// The mass agrees to rounding [1].
constexpr double kExact = 1e-9;

struct Quantity {
  const char* name;
  double error;  // [1]
  Bounds bounds;
};

std::vector<Quantity> quantities(const Certificate& c) {
  std::vector<Quantity> all;
  if (!c.frequencies.empty())
    all.push_back({"natural frequencies", mean_frequency_error(c, 0, kLowestModes), kFrequencies});
  if (c.blow_error) all.push_back({"velocities after an impact", *c.blow_error, kImpacts});
  if (c.first_period_error)
    all.push_back({"first period of vibration", *c.first_period_error, kFirstPeriod});
  if (std::any_of(c.loads.begin(), c.loads.end(),
                  [](const Certificate::Load& load) { return load.held_out; }))
    all.push_back({"local loads", mean_load_error(c, true), kLocalLoads});
  return all;
}

double modulus_error(const Certificate::Moduli& moduli) {
  if (!(moduli.young > 0 && moduli.base_young > 0)) return 0;
  return std::max(moduli.young / moduli.base_young, moduli.base_young / moduli.young) - 1;
}

Grade grade_of(double error, const Bounds& bounds) {
  if (error <= bounds.good) return Grade::good;
  return error <= bounds.fair ? Grade::fair : Grade::rough;
}

/// Two digits: "0.16 %", "2.9 %", "15 %".
std::string percent_text(double fraction) {
  const double percent = 100 * fraction;
  return fmt::format("{:.{}f} %", percent, percent < 1 ? 2 : percent < 10 ? 1 : 0);
}

std::vector<std::string> faults(const Certificate& c) {
  std::vector<std::string> found;
  if (c.zero_modes > c.expected_zero_modes)
    found.push_back(
        fmt::format("{} zero modes instead of {}", c.zero_modes, c.expected_zero_modes));
  if (std::abs(c.mass_error) > kExact)
    found.push_back(fmt::format("its mass is {} off", percent_text(std::abs(c.mass_error))));
  return found;
}

const char* better_than(Grade grade) {
  return grade == Grade::fair ? "good" : "fair";
}

}  // namespace

Grade grade(const Certificate& certificate) {
  if (!faults(certificate).empty()) return Grade::faulty;
  Grade worst = Grade::good;
  for (const Quantity& quantity : quantities(certificate))
    worst = std::max(worst, grade_of(quantity.error, quantity.bounds));
  for (const Certificate::Moduli& moduli : certificate.moduli)
    worst = std::max(worst, grade_of(modulus_error(moduli), kModulus));
  return worst;
}

std::string grade_text(const Certificate& certificate) {
  const Grade worst = grade(certificate);
  std::vector<std::string> deciding = faults(certificate);
  std::vector<std::string> others;
  // Only a quantity outside of the bounds of a better grade has decided on this one.
  const auto add = [&](Grade own, const std::string& text, const std::string& better) {
    if (own != Grade::good && own == worst)
      deciding.push_back(fmt::format("{} ({} is {})", text, better_than(own), better));
    else
      others.push_back(text);
  };
  for (const Quantity& quantity : quantities(certificate)) {
    const Grade own = grade_of(quantity.error, quantity.bounds);
    const double bound = own == Grade::fair ? quantity.bounds.good : quantity.bounds.fair;
    add(own, fmt::format("{} {} off", quantity.name, percent_text(quantity.error)),
        fmt::format("up to {:g} %", 100 * bound));
  }
  for (const Certificate::Moduli& moduli : certificate.moduli) {
    const Grade own = grade_of(modulus_error(moduli), kModulus);
    if (own == Grade::good) continue;
    const double bound = 1 + (own == Grade::fair ? kModulus.good : kModulus.fair);
    add(own,
        fmt::format("{} has {:.2f} of its Young's modulus", moduli.material,
                    moduli.young / moduli.base_young),
        fmt::format("{:.2f} to {:.2f}", 1 / bound, bound));
  }
  return fmt::format("{}: {}{}{}", to_string(worst), fmt::join(deciding, ", "),
                     deciding.empty() || others.empty() ? "" : "; ", fmt::join(others, ", "));
}

}  // namespace springlod::lod
