#pragma once

#include <string>
#include <string_view>

#include "scripting/engine/state.hpp"

namespace springlod::scripting {

/// What is typed at the prompt and is not Lua. A name that a script has defined keeps its meaning.

/// Whether the line is `exit`, `quit()` or the like.
bool asks_to_leave(ScriptState& state, std::string_view line);

/// The chunk that the line stands for: `help` for `help()`, `help s.run` for `help("run")`; any
/// other line itself.
std::string chunk_of(ScriptState& state, std::string_view line);

/// For a line that is a command of the shell, such as `springlod info x.glb`: how to do it in Lua,
/// or where to type it. "" for any other line.
std::string shell_command_answer(ScriptState& state, std::string_view line);

/// For the error of a chunk that calls a function of the API without its table: "did you mean
/// s.simplify?" on a line of its own; "" for other errors.
std::string missing_table_hint(ScriptState& state, std::string_view error);

}  // namespace springlod::scripting
