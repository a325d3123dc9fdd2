#include "model/anchors.hpp"

#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"

namespace springlod::inline model {

std::vector<std::uint32_t> Support::all_nodes() const {
  std::vector<std::uint32_t> all = nodes;
  for (const NodeSpring& spring : springs) all.push_back(spring.node);
  return all;
}

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

void validate(const Support& support, const MassSpringModel& model) {
  anchor_flags(model, support.all_nodes());
  for (const NodeSpring& spring : support.springs)
    if (!(spring.stiffness > 0 && std::isfinite(spring.stiffness)))
      throw InputError(
          fmt::format("anchors: the spring of node {} has a stiffness of {} N/m, which must be "
                      "finite and above 0",
                      script_number(spring.node), spring.stiffness));
}

Support mapped_support(const Groups& of_base, const Support& support) {
  Support coarse(mapped_nodes(of_base, support.nodes));
  mapped_nodes(of_base, support.all_nodes());  // throws for nodes that are not in the map
  for (const NodeSpring& spring : support.springs)
    coarse.springs.push_back({of_base.of[spring.node], spring.stiffness});
  return coarse;
}

}  // namespace springlod::inline model
