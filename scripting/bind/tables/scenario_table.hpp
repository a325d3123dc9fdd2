#pragma once

#include <string>

#include <Eigen/Geometry>

#include "scripting/engine/call.hpp"
#include "sim/scenario.hpp"

namespace springlod::scripting {

/// A scenario from the options of `s.scenario`. Throws InputError naming the key.
sim::Scenario scenario_from_table(Call& call, TableReader& reader);
/// Argument `number`: a Scenario, or a table of options for s.scenario.
std::shared_ptr<const sim::Scenario> scenario_argument(Call& call, int number);
/// Description of such an argument.
Parameter scenario_parameter();

/// The record Turn.
Eigen::AngleAxisd read_turn(const Call& call, int table, const std::string& owner);

/// The records Obstacle, Box, Throw, Turn, Stop and the function scenario.
void describe_scenario(Api& api);

}  // namespace springlod::scripting
