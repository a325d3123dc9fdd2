#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace springlod::inline base {

/// Path of a program found through PATH; empty if it is not installed.
std::optional<std::filesystem::path> find_program(const std::string& name);

struct ProgramResult {
  int exit_code = 0;   ///< 128 + signal number if a signal ended it, as in a shell
  std::string errors;  ///< its stderr
};

/// Runs a program without a shell, in `folder` (empty: the current one), and waits for it. Its
/// stdin is empty and its stdout is discarded. Throws IoError if it cannot be started or waited
/// for.
ProgramResult run_program(const std::filesystem::path& program,
                          const std::vector<std::string>& arguments,
                          const std::filesystem::path& folder = {});

/// Quotes one word for a POSIX shell where needed.
std::string shell_word(const std::string& word);
/// Program and arguments as one line for a POSIX shell.
std::string shell_line(const std::string& program, const std::vector<std::string>& arguments);

}  // namespace springlod::inline base
