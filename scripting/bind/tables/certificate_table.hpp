#pragma once

#include "model/chain.hpp"
#include "scripting/engine/api.hpp"
#include "scripting/engine/value.hpp"
#include "sim/fast/step_time.hpp"

namespace springlod::scripting {

/// Pushes the certificate of a level as the plain table that `info` returns. Means over no values
/// are omitted. The level must have a certificate. `base_time`: of a step of the base, in double
/// precision.
void push_certificate(lua_State* L, const Level& level, const sim::StepTime& base_time);
void describe_certificate(Api& api);

}  // namespace springlod::scripting
