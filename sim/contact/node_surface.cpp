#include "sim/contact/node_surface.hpp"

#include <algorithm>

#include "elastic/stable_step.hpp"

namespace springlod::sim {
namespace {

// Stiffness of a contact over that of the node with its neighbours held [1]. At the smaller one,
// obstacle and surface yield alike, as if the obstacle were of the same material. A contact that is
// stiffer than that sets nodes in motion on their own, faster than a step resolves and than a level
// can follow. The larger one is for bodies whose weight compresses them by percents.
constexpr double kSoftestContact = 0.25;
constexpr double kStiffestContact = 4;

// A body that stands on a face of its bounding box sinks in by less than this fraction of the mean
// length of its springs [1], under this gravity [m/s2].
constexpr double kSinking = 0.01;
constexpr double kEarthGravity = 9.81;

// Contact of a node without springs, which has no stiffness [N/m3].
constexpr double kLooseStiffness = 1e6;

}  // namespace

double bearing_stiffness(const MassSpringModel& model) {
  const double length = mean_spring_length(model);
  if (!(length > 0)) return 0;
  const MassProperties whole = mass_properties(model);
  const double pressure =
      whole.mass / whole.volume * kEarthGravity * bounds(model.rest).diagonal().norm();
  return pressure / (kSinking * length);
}

NodeSurface node_surface(const MassSpringModel& model) {
  std::vector<Vec3> outwards(model.node_count(), Vec3::Zero());
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const Vec3 pull = model.stiffness[s] * spring_direction(model, s);
    outwards[model.a[s]] -= pull;
    outwards[model.b[s]] += pull;
  }
  const std::vector<Mat3> stiffness = elastic::node_stiffness(model);
  const double bearing = bearing_stiffness(model);
  NodeSurface surface;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    const Vec3 normal = outwards[i].normalized();
    surface.normal.push_back(normal);
    const double held = normal.dot(stiffness[i] * normal);
    const double area = model.contact_area[i];
    surface.stiffness.push_back(held);
    surface.contact.push_back(
        held > 0 && area > 0
            ? std::clamp(bearing * area, kSoftestContact * held, kStiffestContact * held)
            : kLooseStiffness * area);
  }
  return surface;
}

}  // namespace springlod::sim
