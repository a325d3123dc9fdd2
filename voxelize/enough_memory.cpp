#include "voxelize/enough_memory.hpp"

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "base/available_memory.hpp"

namespace springlod::voxelize {

void require_memory_of_cells(std::string_view stage, double cells, double bytes, double cell) {
  constexpr double kRoundedUp = 1.01;  // the message has three digits
  const double needed = cells * bytes;
  require_memory(needed, fmt::format("{}: {:.3g} cells of {:.4g} m need", stage, cells, cell),
                 [&](double available) -> std::string {
                   const double fits = kRoundedUp * cell * std::cbrt(needed / available);
                   if (!std::isfinite(fits)) return "free some memory";
                   return fmt::format("use a cell of {:.3g} m or more", fits);
                 });
}

}  // namespace springlod::voxelize
