#include "lod/elastic_targets.hpp"

#include <cmath>
#include <utility>

#include "model/local_loads.hpp"
#include "model/modes.hpp"
#include "model/piece_loads.hpp"
#include "model/stable_step.hpp"

namespace springlod {

ElasticBody held_body(const MassSpringModel& model, const std::vector<std::uint32_t>& anchored,
                      Progress* progress) {
  ElasticBody body = elastic_body(model, {.anchored = anchored, .progress = progress});
  body.anchored.clear();  // solve_static refuses to push at free motions only if there are any
  return body;
}

StaticLoad carried(const Groups& of_base, const StaticLoad& load) {
  StaticLoad coarse{load.name, std::vector<Vec3>(of_base.count, Vec3::Zero())};
  for (std::size_t i = 0; i < load.force.size(); ++i) coarse.force[of_base.of[i]] += load.force[i];
  return coarse;
}

namespace {

struct WeightedLoads {
  double weight = 1;
  std::vector<StaticLoad> loads;
};

std::vector<WeightedLoads> kinds_of_loads(const MassSpringModel& base,
                                          const TargetOptions& options) {
  std::vector<WeightedLoads> kinds;
  if (options.smooth_loads) {
    kinds.push_back({1, smooth_loads(base)});
    kinds.push_back({options.piece_weight, piece_loads(base)});
  }
  if (options.patches > 0 && border_count(base) > 0)
    kinds.push_back({options.patch_weight,
                     patch_pairs(base, {.count = options.patches, .seed = options.seed})});
  return kinds;
}

}  // namespace

ElasticTargets measure_targets(const MassSpringModel& base, const TargetOptions& options) {
  const ElasticBody body = held_body(base, options.anchored, options.progress);
  ElasticTargets targets;
  targets.nodes = base.node_count();
  targets.anchored = options.anchored;
  targets.highest_frequency = largest_frequency(base);
  if (options.modes > 0)
    for (const Mode& mode :
         lowest_modes(body, {.count = options.modes, .progress = options.progress}).modes)
      targets.squared_frequency.push_back(mode.angular_frequency * mode.angular_frequency);

  for (WeightedLoads& kind : kinds_of_loads(base, options)) {
    const std::vector<StaticSolution> solved = solve_static(body, kind.loads);
    for (std::size_t l = 0; l < solved.size(); ++l)
      if (solved[l].compliance > 0)
        targets.loads.push_back({std::move(kind.loads[l]), solved[l].compliance, kind.weight});
    // The first kind is that of the whole body.
    if (options.smooth_loads && targets.smooth_loads == 0)
      targets.smooth_loads = targets.loads.size();
  }
  return targets;
}

}  // namespace springlod
