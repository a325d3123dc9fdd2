#pragma once

#include <optional>
#include <string>

#include "model/mass_spring.hpp"
#include "scripting/engine/call.hpp"

namespace springlod::scripting {

/// The option `start`: positions and velocities of every node, as `trajectory.final` has them; its
/// time is ignored. Empty if it is not given. Throws InputError naming the entry.
std::optional<State> read_start(Call& call, TableReader& options, const MassSpringModel& model);
/// The State table at `index`; `owner` names it in messages. Throws InputError naming the entry.
State state_at(Call& call, int index, const std::string& owner, const MassSpringModel& model);
Parameter start_parameter();

/// The record State.
void describe_start(Api& api);

}  // namespace springlod::scripting
