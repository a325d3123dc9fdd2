#include "model/components.hpp"

#include <cassert>

namespace springlod::inline model {

namespace {

void split_terms(const DilatationTerms& terms, const Components& components,
                 const std::vector<std::uint32_t>& place, std::vector<ModelComponent>& all) {
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t t = 0; t < terms.count(); ++t) {
    ModelComponent& component = all[components.of_node[terms.nodes(t).front()]];
    nodes.clear();
    for (const std::uint32_t node : terms.nodes(t)) nodes.push_back(place[node]);
    component.terms.push_back(t);
    component.model.dilatation.add(terms.modulus[t], terms.damping_time[t], nodes,
                                   terms.gradients(t));
  }
}

void split_surface(const ContactSurface& surface, const Components& components,
                   const std::vector<std::uint32_t>& place, std::vector<ModelComponent>& all) {
  const Binding& from = surface.of_nodes;
  for (std::uint32_t p = 0; p < surface.count(); ++p) {
    const std::uint32_t number = components.of_node[from.node[from.start[p]]];
    ContactSurface& to = all[number].model.surface;
    if (to.of_nodes.start.empty()) to.of_nodes.start.push_back(0);
    for (std::uint32_t e = from.start[p]; e < from.start[p + 1]; ++e) {
      assert(components.of_node[from.node[e]] == number);
      to.of_nodes.node.push_back(place[from.node[e]]);
      to.of_nodes.weight.push_back(from.weight[e]);
    }
    to.of_nodes.start.push_back(static_cast<std::uint32_t>(to.of_nodes.node.size()));
    to.normal.push_back(surface.normal[p]);
    to.area.push_back(surface.area[p]);
    to.stiffness.push_back(surface.stiffness[p]);
  }
}

}  // namespace

std::vector<ModelComponent> split_components(const MassSpringModel& model,
                                             const Components& components) {
  assert(components.of_node.size() == model.node_count());
  std::vector<ModelComponent> all(components.count);
  std::vector<std::uint32_t> place(model.node_count());
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    ModelComponent& component = all[components.of_node[i]];
    place[i] = static_cast<std::uint32_t>(component.nodes.size());
    component.nodes.push_back(i);
    component.model.rest.push_back(model.rest[i]);
    component.model.mass.push_back(model.mass[i]);
    component.model.volume.push_back(model.volume[i]);
    component.model.contact_area.push_back(model.contact_area[i]);
    component.model.border.push_back(model.border[i]);
    component.model.material.push_back(model.material[i]);
  }
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    ModelComponent& component = all[components.of_node[model.a[s]]];
    component.springs.push_back(s);
    component.model.a.push_back(place[model.a[s]]);
    component.model.b.push_back(place[model.b[s]]);
    component.model.rest_length.push_back(model.rest_length[s]);
    component.model.stiffness.push_back(model.stiffness[s]);
    component.model.damping.push_back(model.damping[s]);
  }
  for (const Corner& corner : model.corners) {
    Corner& kept = all[components.of_node[corner.node[0]]].model.corners.emplace_back(corner);
    // Nodes keep their order, so the corners stay in the standard form and sorted.
    for (std::uint32_t& node : kept.node) node = place[node];
  }
  split_terms(model.dilatation, components, place, all);
  split_surface(model.surface, components, place, all);
  for (ModelComponent& component : all) component.model.materials = model.materials;
  return all;
}

}  // namespace springlod::inline model
