#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/choice.hpp"

namespace springlod {

/// Values of one quantity by start, or by start and simplification seed:
/// values[start * seeds + seed].
struct StartSample {
  std::vector<double> values;
  std::uint32_t seeds = 1;
  std::size_t starts() const { return values.size() / seeds; }
};

/// How the seeds of a StartSample relate to its starts.
enum class SeedDesign {
  crossed,  ///< the same seeds in every start: one chain a seed, run from every start
  nested    ///< other seeds in every start
};

inline constexpr Choice<SeedDesign> kSeedDesigns[] = {
    {SeedDesign::crossed, "crossed", "the same seeds in every start: one chain a seed"},
    {SeedDesign::nested, "nested", "other seeds in every start"}};
constexpr ChoiceTable<Choice<SeedDesign>> choices(SeedDesign) {
  return {"seeds", kSeedDesigns};
}

/// Of four starts there are but 35 different resamples, too few for the tail of anything.
constexpr std::size_t kLeastStarts = 5;

/// Throws InputError for fewer than kLeastStarts starts, a value that is not finite, a table with
/// holes. `what` names the sample in the message: "base".
void require_starts(const StartSample& sample, std::string_view what);
/// Throws InputError unless both have as many starts.
void require_pairs(const StartSample& base, const StartSample& other);

}  // namespace springlod
