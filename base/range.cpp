#include "base/range.hpp"

#include <fmt/format.h>

namespace springlod::inline base {

std::string to_string(const Range& range, Dimension dimension) {
  // All digits of plain numbers: "16384", where format_quantity has "1.638e+04".
  if (dimension == Dimension::number) return fmt::format("{} to {}", range.least, range.most);
  return fmt::format("{} to {}", format_quantity(range.least, dimension),
                     format_quantity(range.most, dimension));
}

}  // namespace springlod::inline base
