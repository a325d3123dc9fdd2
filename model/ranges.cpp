#include "model/ranges.hpp"

#include <string_view>

#include <fmt/format.h>

namespace springlod::inline model {

std::string outside(const char* quantity, double value, const PhysicalRange& range) {
  const std::string unit =
      std::string_view(range.unit).empty() ? "" : fmt::format(" {}", range.unit);
  return fmt::format("its {} is {:g}{}; it must lie between {:g} and {:g}{}", quantity, value, unit,
                     range.least, range.most, unit);
}

}  // namespace springlod::inline model
