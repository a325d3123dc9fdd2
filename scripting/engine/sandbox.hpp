#pragma once

struct lua_State;

namespace springlod::scripting {

/// Takes from the standard libraries what a script must not have: other programs, native code,
/// bytecode, finalizers, the debug library but for traceback, and files that
/// session_of(L).files() does not allow. See docs/security.md.
void close_sandbox(lua_State* L);

}  // namespace springlod::scripting
