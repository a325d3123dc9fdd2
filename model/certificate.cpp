#include "model/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"

namespace springlod::inline model {
namespace {

void check_finite(std::initializer_list<double> numbers, const std::string& owner) {
  for (const double number : numbers)
    if (!std::isfinite(number))
      throw InputError(fmt::format("certificate: {} is {}; it must be finite", owner, number));
}

void check_positive_or_zero(std::initializer_list<double> numbers, const std::string& owner) {
  check_finite(numbers, owner);
  for (const double number : numbers)
    if (number < 0)
      throw InputError(fmt::format("certificate: {} is {}; it must be 0 or more", owner, number));
}

}  // namespace

void validate(const Certificate& c) {
  for (const Certificate::Moduli& m : c.moduli)
    check_finite({m.young, m.base_young, m.poisson, m.base_poisson},
                 fmt::format("a modulus of material {}", m.material));
  for (std::size_t i = 0; i < c.frequencies.size(); ++i) {
    const Certificate::Frequency& f = c.frequencies[i];
    const std::string owner = fmt::format("frequency {}", script_number(i));
    check_positive_or_zero({f.level, f.base, f.mac}, owner);
    check_finite({f.decay, f.base_decay}, owner);
    if (f.base <= 0)
      throw InputError(
          fmt::format("certificate: {} of the base is {} Hz; it must be above 0; leave out "
                      "the zero modes",
                      owner, f.base));
  }
  for (const Certificate::Load& load : c.loads)
    check_finite({load.compliance, load.error}, fmt::format("a number of load {}", load.name));
  check_finite({c.mass_error, c.center_shift, c.second_moment_error}, "an error of the mass");
  check_positive_or_zero({c.highest_frequency, c.base_highest_frequency}, "a highest frequency");
  check_positive_or_zero({c.stable_step, c.base_stable_step}, "a stable time step");
  check_positive_or_zero({c.cost, c.base_cost}, "a cost");
  check_finite({c.blow_error.value_or(0), c.first_period_error.value_or(0)},
               "an error of the motion");
  check_positive_or_zero({c.contact_ratio.value_or(0)}, "the contact area over mass");
  check_positive_or_zero({c.tolerance}, "the tolerance");
}

double mean_frequency_error(const Certificate& certificate, std::uint32_t first,
                            std::uint32_t last) {
  const auto& all = certificate.frequencies;
  last = std::min(last, static_cast<std::uint32_t>(all.size()));
  double sum = 0;
  for (std::uint32_t i = first; i < last; ++i) sum += std::abs(all[i].level / all[i].base - 1);
  return last > first ? sum / (last - first) : 0;
}

std::optional<double> mean_mac(const Certificate& certificate) {
  const std::size_t count = std::min(kLowestModes, certificate.frequencies.size());
  if (count == 0) return std::nullopt;
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += certificate.frequencies[i].mac;
  return sum / static_cast<double>(count);
}

std::optional<double> mean_decay_error(const Certificate& certificate) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < std::min(kLowestModes, certificate.frequencies.size()); ++i) {
    const Certificate::Frequency& f = certificate.frequencies[i];
    if (!(f.base_decay > 0)) continue;
    sum += std::abs(f.decay / f.base_decay - 1);
    ++count;
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

double mean_load_error(const Certificate& certificate, bool held_out) {
  double sum = 0;
  int count = 0;
  for (const Certificate::Load& load : certificate.loads) {
    if (load.held_out != held_out) continue;
    sum += std::abs(load.error);
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace springlod::inline model
