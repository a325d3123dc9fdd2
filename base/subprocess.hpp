#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace springlod::inline base {

/// Where PATH has the program; nothing if it is not installed.
std::optional<std::filesystem::path> find_program(const std::string& name);

struct ProgramResult {
  int exit_code = 0;   ///< 128 + signal if it was killed, as in a shell
  std::string errors;  ///< what it wrote to stderr
};

/// Runs a program with these arguments (no shell in between) in `folder` (empty: here) and waits.
/// stdin is empty, stdout is dropped. Throws IoError if it cannot be started.
ProgramResult run_program(const std::filesystem::path& program,
                          const std::vector<std::string>& arguments,
                          const std::filesystem::path& folder = {});

/// One word as a POSIX shell reads it back: quoted where needed.
std::string shell_word(const std::string& word);
/// Program and arguments as a line to paste into a shell.
std::string shell_line(const std::string& program, const std::vector<std::string>& arguments);

}  // namespace springlod::inline base
