#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace springlod::inline base {

/// Path of a program found through PATH; empty if it is not installed.
std::optional<std::filesystem::path> find_program(const std::string& name);

/// Descriptors of this process that a program gets; -1: /dev/null.
struct ProgramStreams {
  int input = -1;
  int output = -1;
  int errors = -1;
  int extra = -1;  ///< as descriptor kExtraStream; -1: none
};
inline constexpr int kExtraStream = 3;

/// Starts a program without a shell, in `folder` (empty: the current one), and returns the number
/// of its process, which must be waited for. Throws IoError if it cannot be started.
pid_t start_program(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                    const ProgramStreams& streams, const std::filesystem::path& folder = {});

/// How a process ended.
struct ProcessEnd {
  int exit_code = 0;
  int signal = 0;  ///< that ended it; 0: none
};
/// Waits for a process that start_program has started. Throws IoError.
ProcessEnd wait_for_program(pid_t process);

struct ProgramResult {
  int exit_code = 0;   ///< 128 + signal number if a signal ended it, as in a shell
  std::string output;  ///< its stdout
  std::string errors;  ///< its stderr
};

/// Runs a program without a shell, in `folder` (empty: the current one), and waits for it. Its
/// stdin is empty. Throws IoError if it cannot be started or waited
/// for.
ProgramResult run_program(const std::filesystem::path& program,
                          const std::vector<std::string>& arguments,
                          const std::filesystem::path& folder = {});

/// Quotes one word for a POSIX shell where needed.
std::string shell_word(const std::string& word);
/// Program and arguments as one line for a POSIX shell.
std::string shell_line(const std::string& program, const std::vector<std::string>& arguments);

}  // namespace springlod::inline base
