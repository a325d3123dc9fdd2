#include "base/subprocess.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/descriptor.hpp"
#include "base/error.hpp"

namespace springlod::inline base {
namespace {

namespace fs = std::filesystem;

class FileActions {
 public:
  FileActions() { posix_spawn_file_actions_init(&actions_); }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  posix_spawn_file_actions_t* get() { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

/// A pipe that is read to its end.
struct ReadPipe {
  int descriptor;
  std::string* text;
};

/// Reads both as they come: a program that waits for one to be read would otherwise never end.
void read_all(std::array<ReadPipe, 2> pipes) {
  std::array<char, 4096> buffer{};
  std::array<pollfd, 2> waiting{};
  for (std::size_t i = 0; i < pipes.size(); ++i) waiting[i] = {pipes[i].descriptor, POLLIN, 0};
  for (std::size_t open = pipes.size(); open > 0;) {
    if (::poll(waiting.data(), waiting.size(), -1) < 0) continue;  // a signal
    for (std::size_t i = 0; i < pipes.size(); ++i) {
      if (waiting[i].revents == 0) continue;
      const ssize_t got = ::read(pipes[i].descriptor, buffer.data(), buffer.size());
      if (got > 0) pipes[i].text->append(buffer.data(), static_cast<std::size_t>(got));
      if (got > 0 || (got < 0 && errno == EINTR)) continue;
      waiting[i].fd = -1;  // its end
      --open;
    }
  }
}

void add_stream(FileActions& actions, int descriptor, int stream, int mode) {
  if (descriptor < 0)
    posix_spawn_file_actions_addopen(actions.get(), stream, "/dev/null", mode, 0);
  else
    posix_spawn_file_actions_adddup2(actions.get(), descriptor, stream);
}

}  // namespace

std::optional<fs::path> find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::string_view rest = path == nullptr ? "" : path;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    const fs::path candidate = fs::path(rest.substr(0, end)) / name;
    std::error_code ignored;
    if (end > 0 && fs::is_regular_file(candidate, ignored) &&
        ::access(candidate.c_str(), X_OK) == 0)
      return fs::absolute(candidate);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return std::nullopt;
}

pid_t start_program(const fs::path& program, const std::vector<std::string>& arguments,
                    const ProgramStreams& streams, const fs::path& folder) {
  FileActions actions;
  add_stream(actions, streams.input, STDIN_FILENO, O_RDONLY);
  add_stream(actions, streams.output, STDOUT_FILENO, O_WRONLY);
  add_stream(actions, streams.errors, STDERR_FILENO, O_WRONLY);
  if (streams.extra >= 0)
    posix_spawn_file_actions_adddup2(actions.get(), streams.extra, kExtraStream);
  if (!folder.empty()) posix_spawn_file_actions_addchdir_np(actions.get(), folder.c_str());

  std::string name = program.string();
  std::vector<std::string> words = arguments;
  std::vector<char*> argv{name.data()};
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t process = 0;
  const int error =
      posix_spawn(&process, program.c_str(), actions.get(), nullptr, argv.data(), environ);
  if (error != 0)
    throw IoError(fmt::format("cannot start {}: {}", program.string(), std::strerror(error)));
  return process;
}

ProcessEnd wait_for_program(pid_t process) {
  int status = 0;
  while (::waitpid(process, &status, 0) < 0)
    if (errno != EINTR)
      throw IoError(fmt::format("cannot wait for process {}: {}", process,
                                std::generic_category().message(errno)));
  if (WIFSIGNALED(status)) return {.signal = WTERMSIG(status)};
  return {.exit_code = WEXITSTATUS(status)};
}

ProgramResult run_program(const fs::path& program, const std::vector<std::string>& arguments,
                          const fs::path& folder) {
  Pipe output = make_pipe(), errors = make_pipe();
  const pid_t process =
      start_program(program, arguments,
                    {.output = output.writing.number(), .errors = errors.writing.number()}, folder);
  for (Pipe* pipe : {&output, &errors}) pipe->writing.close();  // or reading would never end
  ProgramResult result;
  read_all({ReadPipe{output.reading.number(), &result.output},
            {errors.reading.number(), &result.errors}});
  const ProcessEnd end = wait_for_program(process);
  constexpr int kKilledBySignal = 128;  // a shell's convention
  result.exit_code = end.signal != 0 ? kKilledBySignal + end.signal : end.exit_code;
  return result;
}

std::string shell_word(const std::string& word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:=,+%@";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string out = "'";
  for (const char c : word) {
    if (c == '\'')
      out += "'\\''";
    else
      out += c;
  }
  out += '\'';
  return out;
}

std::string shell_line(const std::string& program, const std::vector<std::string>& arguments) {
  std::string line = shell_word(program);
  for (const std::string& argument : arguments) line.append(" ").append(shell_word(argument));
  return line;
}

}  // namespace springlod::inline base
