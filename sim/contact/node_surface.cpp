#include "sim/contact/node_surface.hpp"

#include "elastic/stable_step.hpp"

namespace springlod::sim {

NodeSurface node_surface(const MassSpringModel& model) {
  std::vector<Vec3> outwards(model.node_count(), Vec3::Zero());
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const Vec3 pull = model.stiffness[s] * spring_direction(model, s);
    outwards[model.a[s]] -= pull;
    outwards[model.b[s]] += pull;
  }
  const std::vector<Mat3> stiffness = elastic::node_stiffness(model);
  NodeSurface surface;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    const Vec3 normal = outwards[i].normalized();
    surface.normal.push_back(normal);
    surface.stiffness.push_back(normal.dot(stiffness[i] * normal));
  }
  return surface;
}

}  // namespace springlod::sim
