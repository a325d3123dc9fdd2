#include "sim/contact_skin.hpp"

#include <cmath>

#include <fmt/format.h>

#include "lod/transfer.hpp"
#include "model/error.hpp"

namespace springlod {

ContactSkin contact_skin(const LodChain& chain, std::uint32_t level) {
  const Binding of_nodes = base_from_level(chain, level);
  const MassSpringModel& base = chain.levels[0].model;
  ContactSkin skin;
  skin.of_nodes.start.push_back(0);
  for (std::uint32_t i = 0; i < base.node_count(); ++i) {
    if (!(base.contact_area[i] > 0)) continue;
    for (std::uint32_t e = of_nodes.start[i]; e < of_nodes.start[i + 1]; ++e) {
      skin.of_nodes.node.push_back(of_nodes.node[e]);
      skin.of_nodes.weight.push_back(of_nodes.weight[e]);
    }
    skin.of_nodes.start.push_back(static_cast<std::uint32_t>(skin.of_nodes.node.size()));
    skin.area.push_back(base.contact_area[i]);
    skin.base_node.push_back(i);
  }
  return skin;
}

void validate(const ContactSkin& skin, std::uint32_t node_count) {
  validate(skin.of_nodes, node_count);
  const std::uint32_t points = skin.of_nodes.point_count();
  if (skin.area.size() != points || skin.base_node.size() != points)
    throw InputError(fmt::format("contact skin: {} areas and {} nodes of the base for {} points",
                                 skin.area.size(), skin.base_node.size(), points));
  for (std::uint32_t p = 0; p < points; ++p) {
    if (!(std::isfinite(skin.area[p]) && skin.area[p] > 0))
      throw InputError(fmt::format("contact skin: the area of point {} is {}; it must be above 0",
                                   p, skin.area[p]));
    if (skin.of_nodes.start[p] == skin.of_nodes.start[p + 1])
      throw InputError(fmt::format("contact skin: point {} hangs on no node", p));
  }
}

}  // namespace springlod
