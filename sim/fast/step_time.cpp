#include "sim/fast/step_time.hpp"

#include "sim/fast/fast_model.hpp"

namespace springlod::sim {
namespace {

// Times per spring [s], means of 4k and 40k nodes.
struct SpringTimes {
  double rows, quads;
};
constexpr SpringTimes kDouble{1.76e-9, 3.69e-9};
constexpr SpringTimes kSingle{1.18e-9, 2.02e-9};

}  // namespace

StepTime step_time(const MassSpringModel& model, Precision precision) {
  const SpringTimes& times = precision == Precision::single_precision ? kSingle : kDouble;
  const Kernel kernel = fits_rows(model) ? Kernel::rows : Kernel::quads;
  return {kernel, model.spring_count() * (kernel == Kernel::rows ? times.rows : times.quads)};
}

}  // namespace springlod::sim
