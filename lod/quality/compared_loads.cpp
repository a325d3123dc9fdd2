#include "lod/quality/compared_loads.hpp"

#include <iterator>

#include "elastic/loads.hpp"

namespace springlod::lod {

ComparedLoads compared_loads(const MassSpringModel& base, const ComparedLoadOptions& options) {
  ComparedLoads loads{elastic::smooth_loads(base), 0};
  loads.smooth = loads.all.size();
  if (options.count == 0 || (options.within.empty() && border_count(base) == 0)) return loads;
  // The complement of the seed: the patches of a fit are drawn from the seed itself.
  const elastic::LocalLoadOptions local{.count = options.count,
                                        .seed = ~options.seed,
                                        .radius = options.radius,
                                        .within = options.within};
  for (auto kind : {elastic::pinches(base, local), elastic::pushes(base, local)}) {
    if (!options.within.empty())
      for (elastic::StaticLoad& load : kind) load.name += " within the chosen nodes";
    std::move(kind.begin(), kind.end(), std::back_inserter(loads.all));
  }
  return loads;
}

}  // namespace springlod::lod
