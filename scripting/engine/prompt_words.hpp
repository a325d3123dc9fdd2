#pragma once

#include <string>
#include <string_view>

#include "scripting/engine/state.hpp"

namespace springlod::scripting {

/// What is typed at the prompt and is not Lua. A name that a script has defined keeps its meaning.

/// Whether the line is `exit`, `quit()` or the like.
bool asks_to_leave(ScriptState& state, std::string_view line);

/// The chunk that the line stands for: `help` for `help()`, `help s.run` for `help("run")`,
/// `help(s.seed)` for `help("s.seed")`; any other line itself.
std::string chunk_of(ScriptState& state, std::string_view line);

/// For a line that is a command of the shell, such as `springlod info x.glb`: how to do it in Lua,
/// or where to type it. "" for any other line.
std::string shell_command_answer(ScriptState& state, std::string_view line);

/// For a line `help(mesh)` where no variable mesh exists: says so, and suggests the nearest topic.
/// "" for any other line.
std::string unknown_topic_answer(ScriptState& state, std::string_view line);

/// For a chunk that declares local variables and does nothing else, such as `local q = 1`: what the
/// prompt does with them. "" for other chunks, and for `local s`, which the prompt has anyway.
std::string lost_local_hint(ScriptState& state, std::string_view chunk);

/// For the error of a chunk that calls a function of the API without its table: "did you mean
/// s.simplify?" on a line of its own; "" for other errors.
std::string missing_table_hint(ScriptState& state, std::string_view error);

}  // namespace springlod::scripting
