#include "model/contact_surface.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"

namespace springlod::inline model {

std::uint32_t main_node(const Binding& binding, std::uint32_t point) {
  const auto weights = binding.weight.begin();
  const auto largest =
      std::max_element(weights + binding.start[point], weights + binding.start[point + 1]);
  return binding.node[static_cast<std::size_t>(largest - weights)];
}

void validate(const ContactSurface& surface, std::uint32_t node_count) {
  const std::size_t points = surface.area.size();
  if (surface.of_nodes.point_count() != points || surface.normal.size() != points ||
      surface.stiffness.size() != points)
    throw InputError(fmt::format("contact surface: every array must have {} entries", points));
  validate(surface.of_nodes, node_count);
  constexpr double kUnit = 1e-6;  // largest error of the length of a normal [1]
  for (std::uint32_t p = 0; p < points; ++p) {
    const auto require = [&](bool holds, const char* rule) {
      if (!holds)
        throw InputError(fmt::format("contact surface: point {}: {}", script_number(p), rule));
    };
    require(surface.of_nodes.start[p] < surface.of_nodes.start[p + 1], "it is bound to no node");
    require(std::abs(surface.normal[p].norm() - 1) <= kUnit, "its normal is not a unit vector");
    require(std::isfinite(surface.area[p]) && surface.area[p] > 0, "its area must be above 0");
    require(std::isfinite(surface.stiffness[p]) && surface.stiffness[p] > 0,
            "its stiffness must be above 0");
  }
}

}  // namespace springlod::inline model
