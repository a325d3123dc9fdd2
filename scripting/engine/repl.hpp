#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scripting/engine/interrupt.hpp"
#include "scripting/engine/state.hpp"

namespace springlod::scripting {

/// Runs the interactive prompt with history, completion and multi-line input; it prints the values
/// of expressions. Ctrl-C cancels the line or the running computation. `exit`, `quit` and Ctrl-D
/// end the prompt, and the function returns StopCause::none; after another request to stop, its
/// cause. If stdin is not a terminal, lines are read without editing.
StopCause run_prompt(ScriptState& state);

/// Whether `input` is the start of a chunk.
bool needs_more_lines(ScriptState& state, const std::string& input);

/// Result of evaluating one input.
struct Reply {
  std::string error;  ///< message, under --verbose with its traceback; empty on success
};
/// Evaluates a chunk as the prompt does; prints the values of an expression to stdout.
Reply evaluate(ScriptState& state, const std::string& input);

/// What may stand at the cursor.
struct Completions {
  std::string typed{};               ///< the word before the cursor, with which each name begins
  std::vector<std::string> names{};  ///< sorted
  std::string ending{};  ///< to insert after the name if there is only one: a quote, " = "
  bool colon = false;    ///< the names are methods, which need a colon in place of the dot typed
};
/// Completions of the text before the cursor, by what is expected there: keys and values of the
/// options of a call, file names and words in strings, else names (`s.vox` -> `voxelize`) from
/// globals, keywords, fields and, after a colon, methods.
Completions completions(ScriptState& state, std::string_view before_cursor);

}  // namespace springlod::scripting
