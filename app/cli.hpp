#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scripting/engine/paths.hpp"
#include "scripting/engine/session.hpp"

namespace springlod::app {

/// The parsed command line.
struct CommandLine {
  enum class Action { prompt, code, script, command, standard_input };
  Action action = Action::prompt;
  scripting::Settings settings;
  bool prompt_after = false;           ///< -i
  std::string code;                    ///< of -e
  std::string script;                  ///< of run or of a stock command
  std::vector<std::string> arguments;  ///< for the script or command
};

/// Text and exit code if the program ends without running anything: wrong use, --help, --version.
struct Leave {
  int exit_code = 0;
  std::string text;  ///< to stdout if exit_code is 0, else to stderr
};

/// Result of parse_command_line: a command line to run, or `leave`. Flags stand before the command;
/// --seed, --threads, -q and -v may also follow it.
struct Parsed {
  CommandLine line;
  std::optional<Leave> leave;
};
Parsed parse_command_line(const std::vector<std::string>& arguments,
                          const std::vector<scripting::StockCommand>& commands,
                          bool stdin_is_terminal);

}  // namespace springlod::app
