#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scripting/bind/tables/values.hpp"
#include "scripting/engine/call.hpp"

namespace springlod::scripting {

/// A Comparison or a list of them. `rule`: what the argument must be, for the error of any other
/// value.
std::vector<std::shared_ptr<const ComparisonValue>> comparisons_at(Call& call, int number,
                                                                   const std::string& rule);

}  // namespace springlod::scripting
