#include <fmt/format.h>

#include "base/error.hpp"
#include "report/stats.hpp"

namespace springlod::report {

void require_starts(const StartSample& sample, std::string_view what) {
  if (sample.seeds == 0 || sample.values.size() % sample.seeds != 0)
    throw InputError(
        fmt::format("statistics: the {} values of the sample '{}' do not form a table of {} "
                    "seeds; give the same number of values for every start",
                    sample.values.size(), what, sample.seeds));
  require_sample(sample.values, kLeastStarts * sample.seeds, what);
}

void require_pairs(const StartSample& base, const StartSample& other) {
  if (base.starts() != other.starts())
    throw InputError(
        fmt::format("statistics: {} starts of the base cannot be paired with {} of "
                    "the other; run both from the same starts, or set paired to false",
                    base.starts(), other.starts()));
}

}  // namespace springlod::report
