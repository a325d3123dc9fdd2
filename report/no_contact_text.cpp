#include "report/no_contact_text.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/units.hpp"

namespace springlod::report {
namespace {

std::string short_quantity(double value, Dimension dimension) {
  constexpr double kExactly = 1e-9;  // [SI unit] below this, the digits of a value are rounding
  return std::abs(value) < kExactly
             ? format_quantity(0, dimension)
             : format_quantity(std::stod(fmt::format("{:.3g}", value)), dimension);
}

}  // namespace

std::string no_contact_text(const sim::NoContact& found) {
  const std::string time = short_quantity(found.simulated, Dimension::time);
  if (!found.nearest)
    return fmt::format(
        "the body touches nothing within {}: the scenario has no obstacles, so errors are those of "
        "free motion",
        time);
  return fmt::format(
      "the body touches nothing within {}: it comes no nearer than {} to {} (at {}), so errors are "
      "those of free motion; change throw.position, in metres, or the duration",
      time, short_quantity(std::max(0.0, *found.nearest), Dimension::length),
      found.obstacle.empty() ? "an obstacle" : "the obstacle " + found.obstacle,
      short_quantity(found.nearest_at, Dimension::time));
}

}  // namespace springlod::report
