#include "scripting/bind/tables/comparisons.hpp"

namespace springlod::scripting {

std::vector<report::ComparedChain> compared_chains(
    const std::vector<std::shared_ptr<const ComparisonValue>>& comparisons) {
  std::vector<report::ComparedChain> chains;
  for (const auto& one : comparisons) chains.push_back({*one->chain, one->comparison});
  return chains;
}

}  // namespace springlod::scripting
