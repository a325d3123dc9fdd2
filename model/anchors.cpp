#include "model/anchors.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"

namespace springlod::inline model {

std::vector<std::uint8_t> anchor_flags(const MassSpringModel& model,
                                       const std::vector<std::uint32_t>& anchored) {
  std::vector<std::uint8_t> flags(model.node_count(), 0);
  for (const std::uint32_t node : anchored) {
    if (node >= flags.size())
      throw InputError(fmt::format("anchors: there is no node {}; the model has {}",
                                   script_number(node), flags.size()));
    flags[node] = 1;
  }
  return flags;
}

}  // namespace springlod::inline model
