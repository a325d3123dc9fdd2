#include "lod/elastic_targets.hpp"

#include <cmath>
#include <utility>

#include "model/local_loads.hpp"
#include "model/modes.hpp"
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

  std::vector<StaticLoad> loads;
  if (options.smooth_loads) loads = smooth_loads(base);
  const std::size_t smooth = loads.size();
  if (options.patches > 0 && border_count(base) > 0)
    for (StaticLoad& load : patch_pairs(base, {.count = options.patches, .seed = options.seed}))
      loads.push_back(std::move(load));
  const std::vector<StaticSolution> solved = solve_static(body, loads);
  for (std::size_t l = 0; l < loads.size(); ++l) {
    if (!(solved[l].compliance > 0)) continue;
    targets.loads.push_back(
        {std::move(loads[l]), solved[l].compliance, l < smooth ? 1 : options.patch_weight});
    if (l < smooth) ++targets.smooth_loads;
  }
  return targets;
}

}  // namespace springlod
