#include "lod/calibration/long_springs.hpp"

namespace springlod::lod {

void favour_long_springs(MassSpringModel& model) {
  // The factor is sum k L^2 before over after; the mean length cancels.
  double after = 0;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    after +=
        model.stiffness[s] * model.rest_length[s] * model.rest_length[s] * model.rest_length[s];
  const double factor = spring_work(model) / after;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    model.stiffness[s] *= factor * model.rest_length[s];
    model.damping[s] *= factor * model.rest_length[s];
  }
}

}  // namespace springlod::lod
