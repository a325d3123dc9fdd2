#pragma once

#include "model/certificate.hpp"
#include "scripting/engine/api.hpp"
#include "scripting/engine/value.hpp"

namespace springlod::scripting {

/// Pushes a certificate as the plain table that `info` returns. Means over no values are omitted.
void push_certificate(lua_State* L, const Certificate& certificate);
void describe_certificate(Api& api);

}  // namespace springlod::scripting
