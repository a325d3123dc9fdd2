#include "sim/contact/body_surface.hpp"

#include <algorithm>

#include "sim/contact/node_surface.hpp"

namespace springlod::sim {
namespace {

// Stiffness of the contact at a point of a contact surface over that of the layer of cells under
// it [1]. The area of contact is then the body's own, not widened by the depth to which its points
// sink in: a ball bounces as Hertz's does (docs/validation.md). Stiffer ones are noisy with few
// cells.
constexpr double kSoftestPoint = 4;
// For bodies whose weight compresses them by percents.
constexpr double kStiffestPoint = 16;

BodySurface nodes_with_area(const MassSpringModel& model) {
  const NodeSurface nodes = node_surface(model);
  BodySurface surface;
  surface.of_nodes.start.push_back(0);
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    if (!(model.contact_area[i] > 0)) continue;
    surface.of_nodes.node.push_back(i);
    surface.of_nodes.weight.push_back(1);
    surface.of_nodes.start.push_back(static_cast<std::uint32_t>(surface.of_nodes.node.size()));
    surface.node.push_back(i);
    surface.position.push_back(model.rest[i]);
    surface.normal.push_back(nodes.normal[i]);
    surface.area.push_back(model.contact_area[i]);
    surface.stiffness.push_back(nodes.stiffness[i]);
    surface.contact.push_back(nodes.contact[i]);
  }
  return surface;
}

}  // namespace

BodySurface body_surface(const MassSpringModel& model) {
  if (model.surface.empty()) return nodes_with_area(model);
  const ContactSurface& points = model.surface;
  const double bearing = bearing_stiffness(model);
  BodySurface surface;
  surface.of_nodes = points.of_nodes;
  surface.position = interpolate(points.of_nodes, model.rest);
  surface.normal = points.normal;
  surface.area = points.area;
  surface.stiffness = points.stiffness;
  for (std::uint32_t p = 0; p < points.count(); ++p) {
    surface.node.push_back(main_node(points.of_nodes, p));
    surface.contact.push_back(std::clamp(bearing * points.area[p],
                                         kSoftestPoint * points.stiffness[p],
                                         kStiffestPoint * points.stiffness[p]));
  }
  return surface;
}

}  // namespace springlod::sim
