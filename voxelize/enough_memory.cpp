#include "voxelize/enough_memory.hpp"

#include <cmath>

#include <fmt/format.h>

#include "base/available_memory.hpp"
#include "base/error.hpp"

namespace springlod::voxelize {

void require_memory(std::string_view stage, double cells, double bytes, double cell) {
  constexpr double kGigabyte = 1e9;
  constexpr double kRoundedUp = 1.01;  // the message has three digits
  const double needed = cells * bytes;
  const double available = available_memory();
  if (!(needed > available)) return;
  const double fits = kRoundedUp * cell * std::cbrt(needed / available);
  throw InputError(fmt::format(
      "{}: {:.3g} cells of {:.4g} m need {:.3g} GB of memory, and {:.3g} GB are free; {}", stage,
      cells, cell, needed / kGigabyte, available / kGigabyte,
      std::isfinite(fits) ? fmt::format("use a cell of {:.3g} m or more", fits)
                          : "free some memory"));
}

}  // namespace springlod::voxelize
