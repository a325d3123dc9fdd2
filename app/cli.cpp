#include "app/cli.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string_view>
#include <system_error>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.hpp"
#include "base/message.hpp"
#include "base/units.hpp"
#include "scripting/engine/suggest.hpp"

namespace springlod::app {

namespace {

constexpr int kWrongUse = 2;

// Long flags that suggestions may name.
const std::vector<std::string> kFlags{"--help",       "--version",      "--seed",   "--threads",
                                      "--quiet",      "--verbose",      "--unsafe", "--portable",
                                      "--time-limit", "--memory-limit", "-e",       "-i"};

// Words by which other programs, or the functions of scripts, name what a command does.
constexpr std::pair<std::string_view, const char*> kOtherNames[] = {
    {"create", "new"},       {"draw", "render"},  {"import", "convert"},
    {"init", "new"},         {"inspect", "info"}, {"load", "info"},
    {"plot", "render"},      {"show", "render"},  {"simplify", "convert"},
    {"simulate", "compare"}, {"view", "render"},  {"voxelize", "convert"},
};

struct Switches {
  bool quiet = false;
  bool verbose = false;
  bool unsafe = false;
  bool portable = false;
  std::string seed;
  std::string threads;
  std::string time_limit;
  std::string memory_limit;
};

// What the flags with a value take, as in --help.
constexpr std::pair<std::string_view, std::string_view> kValues[] = {
    {"-e", "CODE"},        {"--seed", "N"},         {"--threads", "N"},
    {"--time-limit", "T"}, {"--memory-limit", "N"},
};

// CLI11 would take "-q=3" for -q and an unknown flag -=3.
constexpr std::string_view kSwitches[] = {"-q",       "--quiet",    "-v", "--verbose",
                                          "--unsafe", "--portable", "-i", "--version",
                                          "-h",       "--help"};

void add_settings(CLI::App& app, Switches& switches) {
  app.add_option("--seed", switches.seed, "seed of all random numbers (default: 1)");
  app.add_option("--threads", switches.threads, "maximum number of threads; 0: all cores");
  app.add_flag("-q,--quiet", switches.quiet, "print only errors to stderr");
  app.add_flag("--unsafe", switches.unsafe, "let scripts use all files and start programs");
  app.add_flag("--portable", switches.portable, "the same results on every processor");
  app.add_option("--time-limit", switches.time_limit, "stop the script after this time");
  app.add_option("--memory-limit", switches.memory_limit, "memory of the script's values");
  app.add_flag("-v,--verbose", switches.verbose,
               "print more, such as each step of a calibration; tracebacks");
}

// An integer from 0 on; an empty text leaves `into` as it is.
template <class Integer>
void read_integer(const char* flag, const std::string& text, Integer& into) {
  if (text.empty()) return;
  Integer value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(text.data(), end, value);
  if (failure != std::errc() || stop != end)
    throw InputError(fmt::format("{}: '{}' must be an integer of 0 to {}", flag, printable(text),
                                 std::numeric_limits<Integer>::max()));
  into = value;
}

// Converts "500MB" to a number of bytes; returns false if the text is none.
bool to_bytes(std::string& text) {
  try {
    return CLI::AsSizeValue(false)(text).empty();
  } catch (const CLI::ValidationError&) {
    return false;  // an unknown unit
  }
}

void read_size(const char* flag, const std::string& text, std::uint64_t& into) {
  std::string bytes = text;
  if (!text.empty() && !to_bytes(bytes))
    throw InputError(fmt::format("{}: '{}' must be a number of bytes, such as 500MB or 4GB", flag,
                                 printable(text)));
  read_integer(flag, bytes, into);
}

void settle(const Switches& switches, scripting::Settings& settings) {
  if (switches.quiet) settings.verbosity = scripting::Verbosity::quiet;
  if (switches.verbose) settings.verbosity = scripting::Verbosity::verbose;
  if (switches.unsafe) settings.sandbox = false;
  if (switches.portable) settings.portable = true;
  read_integer("--seed", switches.seed, settings.seed);
  read_integer("--threads", switches.threads, settings.threads);
  read_size("--memory-limit", switches.memory_limit, settings.script_memory);
  if (!switches.time_limit.empty())
    settings.time_limit = parse_quantity(switches.time_limit, Dimension::time, "--time-limit");
  if (!(settings.time_limit >= 0)) throw InputError("--time-limit must be at least 0");
}

std::vector<std::string> reversed(std::vector<std::string> words) {
  std::reverse(words.begin(), words.end());  // the order that CLI::App::parse expects
  return words;
}

std::string usage_text(const std::vector<scripting::StockCommand>& commands) {
  std::string text = fmt::format(
      "springlod {} - level-of-detail mass-spring models from meshes, scripted in Lua\n\n"
      "usage: springlod [FLAGS] COMMAND ARGUMENTS...   run a command, see below\n"
      "       springlod [FLAGS] run SCRIPT.lua [-- ARGUMENTS...]\n"
      "       springlod [FLAGS] -e CODE\n"
      "       springlod [FLAGS]                        open a prompt; or run stdin\n\n"
      "commands (springlod help COMMAND explains one; springlod help lists all topics):\n",
      scripting::version());
  std::size_t width = 3;
  for (const scripting::StockCommand& command : commands)
    width = std::max(width, command.name.size());
  text += fmt::format("  {:<{}}  {}\n", "run", width, "Run a Lua script.");
  for (const bool study : {false, true}) {
    if (study) text += "\nstudies, which evaluate the methods:\n";
    for (const scripting::StockCommand& command : commands)
      if (command.study == study)
        text += fmt::format("  {:<{}}  {}\n", command.name, width, command.summary);
  }
  return text +
         "\nflags (--seed, --threads, -q and -v may also follow the command):\n"
         "  -e CODE        run CODE\n"
         "  -i             open a prompt afterwards\n"
         "  --seed N       seed of all random numbers (default: 1)\n"
         "  --threads N    maximum number of threads (default: 0, all cores)\n"
         "  -q, --quiet    print only errors to stderr\n"
         "  -v, --verbose  print more, such as each step of a calibration; tracebacks\n"
         "  --time-limit T    stop the script after T, such as 10min (default: none)\n"
         "  --memory-limit N  memory of the script's own values (default: 4GB)\n"
         "  --portable     the same results on every processor, slower (docs/files.md)\n"
         "  --unsafe       let scripts use all files and start programs (docs/security.md)\n"
         "  --version      print the version\n"
         "  -h, --help     print this help\n";
}

Leave wrong_use(const std::string& message) {
  return {kWrongUse, fmt::format("springlod: {}\ntry: springlod --help\n", message)};
}

Leave unknown_flag(const std::string& flag) {
  return wrong_use(fmt::format("unknown flag {}{}", flag,
                               scripting::did_you_mean(flag.substr(0, flag.find('=')), kFlags)));
}

Leave unknown_command(const std::string& name,
                      const std::vector<scripting::StockCommand>& commands) {
  const std::string printed = printable(name);
  const auto perhaps = [&](const char* command) {
    return wrong_use(
        fmt::format("unknown command '{0}'; did you mean: springlod {1} {0}?", printed, command));
  };
  if (name.ends_with(".lua")) return perhaps("run");
  // No command has a dot, and files have one.
  if (std::error_code ignored;
      name.find('.') != std::string::npos || std::filesystem::is_regular_file(name, ignored))
    return wrong_use(
        fmt::format("unknown command '{0}'; for a mesh or an asset: springlod info {0}, or "
                    "springlod render {0}",
                    printed));
  std::vector<std::string> names{"run"};
  for (const scripting::StockCommand& command : commands) names.push_back(command.name);
  std::string question = scripting::did_you_mean(name, names);
  for (const auto& [other, command] : kOtherNames)
    if (name == other) question = fmt::format("; did you mean '{}'?", command);
  return wrong_use(
      fmt::format("unknown command '{}'{}", printed,
                  question.empty() ? "; commands are: " + scripting::comma_list(names) : question));
}

// In the words of our other messages: "--seed needs a value: --seed N".
std::string reason_of(const CLI::ParseError& error) {
  const std::string text = error.what();
  for (const auto& [flag, value] : kValues)
    if (text.starts_with(std::string(flag) + ":"))
      return text.find("missing") != std::string::npos
                 ? fmt::format("{0} needs a value: {0} {1}", flag, value)
                 : fmt::format("give {} once", flag);
  return text;
}

// An error if a flag that takes no value has one: -q=3.
std::optional<Leave> refuse_values(const std::vector<std::string>& arguments) {
  for (const std::string& word : arguments) {
    const std::string_view flag = std::string_view(word).substr(0, word.find('='));
    if (flag.size() < word.size() && std::ranges::count(kSwitches, flag) > 0)
      return wrong_use(fmt::format("{} takes no value", flag));
  }
  return std::nullopt;
}

// The flags before the command, with their values.
std::vector<std::string> front_of(const std::vector<std::string>& arguments) {
  std::vector<std::string> front;
  bool value = false;  // of the flag before
  for (const std::string& word : arguments) {
    if (!value && (word == "--" || !word.starts_with("-"))) break;
    value =
        !value && std::ranges::any_of(kValues, [&](const auto& row) { return row.first == word; });
    front.push_back(word);
  }
  return front;
}

// Parses arguments with the flags of add_settings.
std::optional<Leave> parse_settings(CLI::App& app, std::vector<std::string> arguments,
                                    const Switches& switches, scripting::Settings& settings) {
  try {
    app.parse(reversed(std::move(arguments)));
    settle(switches, settings);
  } catch (const CLI::ParseError& error) {
    return wrong_use(reason_of(error));
  } catch (const InputError& error) {
    return wrong_use(error.what());
  }
  return std::nullopt;
}

// Parses the flags before the command. The other arguments go to `rest`.
std::optional<Leave> parse_front(const std::vector<std::string>& arguments,
                                 const std::vector<scripting::StockCommand>& commands,
                                 CommandLine& line, std::vector<std::string>& rest) {
  CLI::App app;
  Switches switches;
  bool help = false;
  bool show_version = false;
  app.set_help_flag("");
  app.prefix_command();
  app.add_flag("-h,--help", help);
  app.add_flag("--version", show_version);
  app.add_option("-e", line.code);
  app.add_flag("-i", line.prompt_after);
  add_settings(app, switches);
  if (auto leave = refuse_values(front_of(arguments))) return leave;
  if (auto leave = parse_settings(app, arguments, switches, line.settings)) return leave;
  rest = app.remaining();
  if (help) return Leave{0, usage_text(commands)};
  if (show_version) return Leave{0, fmt::format("springlod {}\n", scripting::version())};
  if (app.count("-e") > 0) line.action = CommandLine::Action::code;
  return std::nullopt;
}

// Parses the settings among the arguments of a command. The others go to its script, in order.
std::optional<Leave> parse_back(const std::vector<std::string>& arguments, bool own_script,
                                CommandLine& line) {
  // Arguments after "--" belong to the script.
  const auto separator = std::find(arguments.begin(), arguments.end(), "--");
  CLI::App app;
  Switches switches;
  app.set_help_flag("");
  app.allow_extras();
  add_settings(app, switches);
  if (own_script) app.add_flag("-i", line.prompt_after);
  const std::vector<std::string> own(arguments.begin(), separator);
  if (auto leave = refuse_values(own)) return leave;
  if (auto leave = parse_settings(app, own, switches, line.settings)) return leave;
  line.arguments = app.remaining();
  if (separator != arguments.end())
    line.arguments.insert(line.arguments.end(), separator + (own_script ? 1 : 0), arguments.end());
  return std::nullopt;
}

Leave run_help() {
  return {
      0,
      "usage: springlod [FLAGS] run SCRIPT.lua [-- ARGUMENTS...]\n\n"
      "Run a Lua script. It gets the arguments after -- as `...` and in the table `arg`, and may\n"
      "use the files that they name and those below the current folder (docs/security.md).\n\n"
      "flags:\n"
      "  -i             open a prompt afterwards\n"
      "  --seed N, --threads N, -q, -v, --time-limit T, --memory-limit N, --portable, --unsafe\n"
      "                 as for every command: springlod --help\n\n"
      "A script begins with: local s = require \"springlod\". springlod help lists the\n"
      "functions of s, springlod help simplify explains one of them.\n"};
}

std::optional<Leave> parse_run(const std::vector<std::string>& arguments, CommandLine& line) {
  line.action = CommandLine::Action::script;
  if (auto leave = parse_back(arguments, true, line)) return leave;
  if (line.arguments.empty()) return wrong_use("run needs a script: springlod run SCRIPT.lua");
  if (line.arguments.front() == "--help" || line.arguments.front() == "-h") return run_help();
  line.script = line.arguments.front();
  line.arguments.erase(line.arguments.begin());
  if (line.script.starts_with("-")) return unknown_flag(line.script);
  return std::nullopt;
}

std::optional<Leave> parse_rest(const std::vector<std::string>& rest,
                                const std::vector<scripting::StockCommand>& commands,
                                bool stdin_is_terminal, CommandLine& line) {
  if (line.action == CommandLine::Action::code) {
    line.arguments = rest;
    return std::nullopt;
  }
  if (rest.empty()) {
    const bool talk = stdin_is_terminal || line.prompt_after;
    line.action = talk ? CommandLine::Action::prompt : CommandLine::Action::standard_input;
    return std::nullopt;
  }
  if (rest.front().starts_with("-")) return unknown_flag(rest.front());
  const std::vector<std::string> arguments(rest.begin() + 1, rest.end());
  if (rest.front() == "run") return parse_run(arguments, line);
  const auto known = std::find_if(commands.begin(), commands.end(), [&](const auto& command) {
    return command.name == rest.front();
  });
  if (known == commands.end()) return unknown_command(rest.front(), commands);
  line.action = CommandLine::Action::command;
  line.script = known->script.string();
  return parse_back(arguments, false, line);
}

}  // namespace

Parsed parse_command_line(const std::vector<std::string>& arguments,
                          const std::vector<scripting::StockCommand>& commands,
                          bool stdin_is_terminal) {
  Parsed parsed;
  std::vector<std::string> rest;
  parsed.leave = parse_front(arguments, commands, parsed.line, rest);
  if (!parsed.leave) parsed.leave = parse_rest(rest, commands, stdin_is_terminal, parsed.line);
  return parsed;
}

}  // namespace springlod::app
