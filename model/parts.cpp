#include "model/parts.hpp"

#include <cassert>

namespace springlod::inline model {

std::vector<ModelPart> split_parts(const MassSpringModel& model, const Components& components) {
  assert(components.of_node.size() == model.node_count());
  std::vector<ModelPart> parts(components.count);
  std::vector<std::uint32_t> place(model.node_count());
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    ModelPart& part = parts[components.of_node[i]];
    place[i] = static_cast<std::uint32_t>(part.nodes.size());
    part.nodes.push_back(i);
    part.model.rest.push_back(model.rest[i]);
    part.model.mass.push_back(model.mass[i]);
    part.model.volume.push_back(model.volume[i]);
    part.model.contact_area.push_back(model.contact_area[i]);
    part.model.border.push_back(model.border[i]);
    part.model.material.push_back(model.material[i]);
  }
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    ModelPart& part = parts[components.of_node[model.a[s]]];
    part.springs.push_back(s);
    part.model.a.push_back(place[model.a[s]]);
    part.model.b.push_back(place[model.b[s]]);
    part.model.rest_length.push_back(model.rest_length[s]);
    part.model.stiffness.push_back(model.stiffness[s]);
    part.model.damping.push_back(model.damping[s]);
  }
  for (ModelPart& part : parts) part.model.materials = model.materials;
  return parts;
}

}  // namespace springlod::inline model
