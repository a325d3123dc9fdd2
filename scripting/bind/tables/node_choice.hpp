#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/mass_spring.hpp"
#include "scripting/engine/call.hpp"

namespace springlod::scripting {

/// Reads a choice of nodes at `index`: a list of node numbers (counted from 1), or a function of a
/// Node that returns true for the chosen nodes. `what` names the value in messages.
std::vector<std::uint32_t> nodes_at(lua_State* L, int index, const MassSpringModel& model,
                                    const std::string& what);
/// The option `name`; empty if it is not given.
std::vector<std::uint32_t> read_nodes(TableReader& reader, const char* name,
                                      const MassSpringModel& model);
/// The option `force`: a table from node number to {x, y, z} [N] or a function of a Node that
/// returns the force, or nil for zero. Returns N forces; all are zero if the option is not given.
std::vector<Vec3> read_forces(TableReader& reader, const MassSpringModel& model);

}  // namespace springlod::scripting
