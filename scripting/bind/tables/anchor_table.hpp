#pragma once

#include <vector>

#include "model/anchors.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/engine/api.hpp"
#include "scripting/engine/call.hpp"
#include "sim/held/anchor.hpp"

namespace springlod::scripting {

/// The option `anchored` of runs: what holds nodes of the model; empty if it is not given. The same
/// values are taken by loads and modes (read_anchored).
std::vector<sim::Anchor> read_anchors(const Call& call, TableReader& reader,
                                      const MassSpringModel& model);
Parameter anchors_parameter();
/// What that option is in linear elasticity.
Support read_anchored(const Call& call, TableReader& reader, const MassSpringModel& model);
Parameter anchored_parameter();
inline constexpr const char* kAnchoredType = "list of integers, function or list of Anchor";

/// The loads of the anchors of a trajectory, by frame.
void push_anchor_loads(lua_State* L, const TrajectoryValue& value);

/// The records Anchor and Pose.
void describe_anchors(Api& api);

}  // namespace springlod::scripting
