#pragma once

#include "model/chain.hpp"
#include "scripting/engine/api.hpp"
#include "scripting/engine/value.hpp"

namespace springlod::scripting {

/// Pushes the certificate of a level as the plain table that `info` returns. Means over no values
/// are omitted. The level must have a certificate.
void push_certificate(lua_State* L, const MassSpringModel& base, const Level& level);
void describe_certificate(Api& api);

}  // namespace springlod::scripting
