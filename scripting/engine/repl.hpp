#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scripting/engine/state.hpp"

namespace springlod::scripting {

/// The prompt: history, completion, input over several lines; an expression prints its value.
/// Ctrl-C abandons the line or the running computation, Ctrl-D leaves. Returns when the user
/// leaves. Where stdin is no terminal, lines are read without editing.
void run_prompt(ScriptState& state);

/// What running one input came to.
struct Reply {
  bool incomplete = false;  ///< more lines are needed
  std::string error;        ///< message with traceback; empty if it went well
};
/// Runs a chunk as the prompt does and prints the values of an expression on stdout.
Reply evaluate(ScriptState& state, const std::string& input);

/// Words that the text before the cursor may be completed to: what stands for the last name or
/// path (`s.vox` -> `voxelize`), from globals, fields, methods and keywords.
std::vector<std::string> completions(ScriptState& state, std::string_view before_cursor);

}  // namespace springlod::scripting
