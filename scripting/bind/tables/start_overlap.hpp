#pragma once

#include <optional>
#include <string>

#include "model/mass_spring.hpp"
#include "sim/scenario.hpp"

namespace springlod::scripting {

/// A warning for a body that the scenario places deep inside an obstacle, whose contact then throws
/// it out: the deepest node is more than half a mean spring length inside. Nothing otherwise.
/// `owner`: the function that warns.
std::optional<std::string> overlap_warning(const std::string& owner, const MassSpringModel& model,
                                           const sim::Scenario& scenario);

}  // namespace springlod::scripting
