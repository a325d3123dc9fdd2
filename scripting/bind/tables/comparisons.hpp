#pragma once

#include <memory>
#include <vector>

#include "report/filmed_run.hpp"
#include "scripting/bind/tables/values.hpp"

namespace springlod::scripting {

/// The comparisons with their assets. They refer to `comparisons`.
std::vector<report::ComparedChain> compared_chains(
    const std::vector<std::shared_ptr<const ComparisonValue>>& comparisons);

}  // namespace springlod::scripting
