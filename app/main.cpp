#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "app/cli.hpp"
#include "app/portable.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/interrupt.hpp"
#include "scripting/engine/paths.hpp"
#include "scripting/engine/repl.hpp"
#include "scripting/engine/state.hpp"

namespace {

namespace scripting = springlod::scripting;
using scripting::Outcome;
using scripting::ScriptState;
using springlod::app::CommandLine;

constexpr int kFailed = 1;

Outcome run_action(ScriptState& state, const CommandLine& line) {
  switch (line.action) {
    case CommandLine::Action::code:
      return state.run_text(line.code, "-e", line.arguments);
    case CommandLine::Action::script:
    case CommandLine::Action::command:
      return state.run_file(line.script, line.arguments);
    case CommandLine::Action::standard_input:
      return state.run_text(std::string(std::istreambuf_iterator<char>(std::cin), {}), "stdin", {});
    case CommandLine::Action::prompt:
      break;
  }
  return {};
}

// Scripts may use the files that the user names: "x.glb", "-ox.glb", "--out=folder".
void allow_arguments(scripting::FileAccess& files, const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    const std::size_t equals = argument.find('=');
    if (!argument.starts_with("-"))
      files.allow_named(argument);
    else if (equals != std::string::npos)
      files.allow_named(argument.substr(equals + 1));
    else if (!argument.starts_with("--") && argument.size() > 2)
      files.allow_named(argument.substr(2));
  }
}

int run(char** argv, const std::vector<std::string>& arguments) {
  const springlod::app::Parsed parsed = springlod::app::parse_command_line(
      arguments, scripting::stock_commands(), isatty(STDIN_FILENO) != 0);
  if (parsed.leave) {
    std::fputs(parsed.leave->text.c_str(), parsed.leave->exit_code == 0 ? stdout : stderr);
    return parsed.leave->exit_code;
  }
  const CommandLine& line = parsed.line;
  if (line.settings.portable)
    springlod::app::make_portable(argv);
  else
    springlod::app::fix_blas_kernels(argv);
  springlod::app::fix_block_sizes();
  const scripting::InterruptHandler interrupts(line.settings.time_limit);
  ScriptState state(line.settings, scripting::make_api());
  allow_arguments(state.session().files(), line.arguments);
  const Outcome outcome = run_action(state, line);
  const scripting::StopCause stop = scripting::stop_cause();  // the prompt clears it
  if (outcome.interrupted)
    fmt::print(stderr, "springlod: {}\n", scripting::stop_text(stop));
  else if (!outcome.done)
    fmt::print(stderr, "springlod: {}\n", scripting::failure_text(state, outcome));
  const bool asked = line.action == CommandLine::Action::prompt || line.prompt_after;
  if (asked && stop != scripting::StopCause::termination) {
    const scripting::StopCause end = scripting::run_prompt(state);
    if (end != scripting::StopCause::none) {
      fmt::print(stderr, "springlod: {}\n", scripting::stop_text(end));
      return scripting::stop_exit_code(end);
    }
  }
  if (outcome.interrupted) return scripting::stop_exit_code(stop);
  return outcome.done ? 0 : kFailed;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files: writing fails, with a message
  int exit_code = kFailed;
  try {
    exit_code = run(argv, {argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "springlod: {}\n", error.what());
  }
  // Failing to write results is a failure, also one that an earlier flush has had.
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    std::fputs("springlod: cannot write all of the standard output\n", stderr);
    exit_code = kFailed;
  }
  return exit_code;
}
