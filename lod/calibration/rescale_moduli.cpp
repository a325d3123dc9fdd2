#include "lod/calibration/rescale_moduli.hpp"

#include <cmath>
#include <vector>

namespace springlod::lod {
namespace {

std::vector<double> work_by_material(const MassSpringModel& model) {
  std::vector<double> work(model.materials.size(), 0);
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const double half = model.stiffness[s] * model.rest_length[s] * model.rest_length[s] / 2;
    work[model.material[model.a[s]]] += half;
    work[model.material[model.b[s]]] += half;
  }
  return work;
}

}  // namespace

void rescale_moduli(const MassSpringModel& base, MassSpringModel& level) {
  const std::vector<double> wanted = work_by_material(base);
  const std::vector<double> found = work_by_material(level);
  std::vector<double> root;  // square root of each material's factor
  for (std::size_t m = 0; m < wanted.size(); ++m)
    root.push_back(found[m] > 0 ? std::sqrt(wanted[m] / found[m]) : 1);
  for (std::uint32_t s = 0; s < level.spring_count(); ++s) {
    const double factor = root[level.material[level.a[s]]] * root[level.material[level.b[s]]];
    level.stiffness[s] *= factor;
    level.damping[s] *= factor;
  }
}

}  // namespace springlod::lod
