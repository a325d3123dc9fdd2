#include "sim/study/stability_body.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "base/error.hpp"
#include "elastic/modes.hpp"
#include "elastic/zero_modes.hpp"
#include "sim/integrators/step_limit.hpp"
#include "sim/study/stiffness_ratio.hpp"

namespace springlod::sim {
namespace {

// Number of modes used to evaluate a level.
constexpr std::uint32_t kModes = 6;

// The reference's step as a fraction of the limit [1]: a mode of half the highest frequency has a
// relative phase error of 1/800, and smooth motion a much smaller one.
constexpr double kReferencePart = 0.25;

// Distance from a run with twice the step, divided by the error, for a scheme of second order [1].
constexpr double kOrderGain = 3;

std::vector<double> lowest_frequencies(const Level& level, const StabilityOptions& options) {
  const elastic::ElasticBody body = elastic::elastic_body(
      level.model, {.anchored = support_of(mapped(options.anchors, level.of_base), level.model)});
  std::vector<double> frequencies;
  for (const elastic::Mode& mode :
       elastic::lowest_modes(body, {.count = kModes, .seed = options.seed}).modes)
    frequencies.push_back(mode.angular_frequency);
  return frequencies;
}

double mean_error(const std::vector<double>& found, const std::vector<double>& wanted) {
  const std::size_t count = std::min(found.size(), wanted.size());
  if (count == 0) return 0;
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += std::abs(found[i] / wanted[i] - 1);
  return sum / static_cast<double>(count);
}

/// sum of m |x - y|^2 over nodes and the frames 1 to kSamples - 1.
double squared_distance(const MassSpringModel& model, const std::vector<Frame>& frames,
                        const std::function<const Vec3&(std::size_t frame, std::size_t node)>& y) {
  double sum = 0;
  for (std::size_t f = 1; f < std::min<std::size_t>(frames.size(), kSamples); ++f)
    for (std::size_t i = 0; i < frames[f].x.size(); ++i)
      sum += model.mass[i] * (frames[f].x[i] - y(f, i)).squaredNorm();
  return sum;
}

std::vector<Frame> fine_run(const MassSpringModel& model, const Specimen& specimen, double step,
                            Progress* progress) {
  const RunOptions options{.integrator = Integrator::velocity_verlet,
                           .step = step,
                           .frame_rate = kSamples / specimen.scene.duration,
                           .ledger = false,
                           .anchors = specimen.anchors,
                           .progress = progress};
  return run(model, specimen.scene, specimen.start, options).frames;
}

}  // namespace

std::vector<std::uint32_t> loose_nodes(const Level& level, const std::vector<Anchor>& anchors) {
  std::vector<std::uint32_t> loose;
  for (const elastic::ComponentModes& part :
       elastic::zero_modes(level.model, nodes_of(mapped(anchors, level.of_base))))
    loose.insert(loose.end(), part.mechanism_nodes.begin(), part.mechanism_nodes.end());
  return loose;
}

RescaledChain rescaled_chain(const LodChain& chain, double ratio, const StabilityOptions& options) {
  RescaledChain at_ratio;
  const StiffPart part = stiff_part(chain.levels.front().model);
  at_ratio.chain = with_stiffness_ratio(chain, part, ratio);
  if (!options.remake_levels)
    std::copy(chain.levels.begin() + 1, chain.levels.end(), at_ratio.chain.levels.begin() + 1);
  for (Level& level : at_ratio.chain.levels) level.certificate.reset();  // of other springs
  if (!options.damping)
    for (Level& level : at_ratio.chain.levels)
      std::fill(level.model.damping.begin(), level.model.damping.end(), 0.0);
  const MassSpringModel& base = at_ratio.chain.levels.front().model;
  at_ratio.frequencies = lowest_frequencies(at_ratio.chain.levels.front(), options);
  if (at_ratio.frequencies.empty())
    throw InputError(
        "stability: the base has no mode that springs resist; it needs nodes joined by springs");
  at_ratio.period = 2 * std::numbers::pi / at_ratio.frequencies.front();
  at_ratio.motion = probe_motion(base, at_ratio.frequencies.front(),
                                 options.duration.value_or(options.periods * at_ratio.period));
  return at_ratio;
}

double Specimen::error(const MassSpringModel& model, const std::vector<Frame>& frames) const {
  const double off = squared_distance(
      model, frames,
      [&](std::size_t f, std::size_t i) -> const Vec3& { return reference[f].x[i]; });
  return std::sqrt(off) / reference_displacement;
}

Specimen make_specimen(const std::shared_ptr<const RescaledChain>& at_ratio,
                       const StabilityOptions& options, std::array<Progress*, 2> progress,
                       StabilityBody& body) {
  const MassSpringModel& model = at_ratio->chain.levels[body.level].model;
  Specimen specimen;
  specimen.at_ratio = at_ratio;
  specimen.anchors = mapped(options.anchors, at_ratio->chain.levels[body.level].of_base);
  specimen.held = support_of(specimen.anchors, model).nodes;
  specimen.start = probe_state(model, at_ratio->motion, nodes_of(specimen.anchors));
  specimen.scene.name = "probe";
  specimen.scene.gravity = Vec3::Zero();
  specimen.scene.duration = at_ratio->motion.duration;

  body.nodes = model.node_count();
  body.springs = model.spring_count();
  body.period = at_ratio->period;
  body.duration = specimen.scene.duration;
  const StepLimit limit = step_limit(model, Integrator::symplectic_euler, specimen.held);
  body.limit = limit.step;
  body.limited_by = limit.limited_by();
  if (body.loose_nodes > 0) return specimen;
  if (body.level > 0)
    body.frequency_error = mean_error(
        lowest_frequencies(at_ratio->chain.levels[body.level], options), at_ratio->frequencies);

  const double step =
      std::min(kReferencePart * predicted_step(model, Integrator::velocity_verlet, specimen.held),
               specimen.scene.duration / kSamples);
  specimen.reference = fine_run(model, specimen, step, progress[0]);
  specimen.reference_displacement = std::sqrt(squared_distance(
      model, specimen.reference,
      [&](std::size_t, std::size_t i) -> const Vec3& { return specimen.start.x[i]; }));
  body.reference_error =
      specimen.error(model, fine_run(model, specimen, 2 * step, progress[1])) / kOrderGain;
  return specimen;
}

}  // namespace springlod::sim
