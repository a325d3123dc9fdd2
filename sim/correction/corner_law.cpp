#include "sim/correction/corner_law.hpp"

#include "sim/contact/normal_law.hpp"

namespace springlod::sim {
namespace {

// K over E V0 / 8 [1]: a cell takes up 2.4 E V0 until it is flat, more than the kinetic energy of
// its material at twice its wave speed. Softer corners let fast impacts through; stiffer ones lose
// more energy where they are cut short by the cap on their displacement.
constexpr double kStiffness = 30;

}  // namespace

double corner_stiffness(const Corner& corner, double rest_volume) {
  return kStiffness * corner.young * rest_volume / 8;
}

double corner_energy(const MassSpringModel& model, const std::vector<Vec3>& x) {
  double energy = 0;
  for (const Corner& corner : model.corners) {
    const double rest = corner_volume(corner, model.rest);
    const double depth = kCornerResists - corner_volume(corner, x) / rest;
    if (depth > 0) energy += penalty_energy(corner_stiffness(corner, rest), depth);
  }
  return energy;
}

}  // namespace springlod::sim
