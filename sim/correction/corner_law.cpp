#include "sim/correction/corner_law.hpp"

#include "sim/contact/normal_law.hpp"

namespace springlod::sim {
namespace {

// K over E V0 / 8 [1]: a cell takes up 8 E V0 until it is flat, more than the kinetic energy of its
// material at four times its wave speed. With 30, strained springs hold single corners of merged
// joints inside out; stiffer ones lose more energy where they are cut short by the cap on their
// displacement.
constexpr double kStiffness = 100;

double energy_of(const MassSpringModel& model, const Corner& corner, const std::vector<Vec3>& x) {
  const double rest = corner_volume(corner, model.rest);
  const double depth = kCornerResists - corner_volume(corner, x) / rest;
  return depth > 0 ? penalty_energy(corner_stiffness(corner, rest), depth) : 0;
}

}  // namespace

double corner_stiffness(const Corner& corner, double rest_volume) {
  return kStiffness * corner.young * rest_volume / 8;
}

double corner_energy(const MassSpringModel& model, const std::vector<Vec3>& x) {
  double energy = 0;
  for (const Corner& corner : model.corners) energy += energy_of(model, corner, x);
  return energy;
}

double corner_energy(const MassSpringModel& model, const std::vector<std::uint32_t>& corners,
                     const std::vector<Vec3>& x) {
  double energy = 0;
  for (const std::uint32_t c : corners) energy += energy_of(model, model.corners[c], x);
  return energy;
}

}  // namespace springlod::sim
