#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scripting/engine/paths.hpp"
#include "scripting/engine/session.hpp"

namespace springlod::app {

/// What the command line asks for.
struct CommandLine {
  enum class Action { prompt, code, script, command, standard_input };
  Action action = Action::prompt;
  scripting::Settings settings;
  bool prompt_after = false;           ///< -i
  std::string code;                    ///< of -e
  std::string script;                  ///< of run
  std::string command;                 ///< a stock command
  std::vector<std::string> arguments;  ///< for the script or command
};

/// Wrong use, or a text that was asked for (--help, --version): what to print and how to exit.
struct Leave {
  int exit_code = 0;
  std::string text;  ///< to stdout if exit_code is 0, else to stderr
};

/// Global flags may stand before the command, and --seed, --threads, -q, -v after it as well.
/// Returns either.
struct Parsed {
  CommandLine line;
  std::optional<Leave> leave;
};
Parsed parse_command_line(const std::vector<std::string>& arguments,
                          const std::vector<scripting::StockCommand>& commands,
                          bool stdin_is_terminal);

}  // namespace springlod::app
