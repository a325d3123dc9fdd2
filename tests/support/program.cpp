#include "tests/support/program.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <pty.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace springlod::test {

namespace fs = std::filesystem;

namespace {

// Timeout for a program that hangs; far longer than any test takes [ms].
constexpr int kPatience = 240'000;

const std::string kProgram = (build_folder() / "app/springlod").string();

struct Pipe {
  explicit Pipe(int flags = 0) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC | flags) != 0) throw std::runtime_error("no pipe");
    read_end = ends[0];
    write_end = ends[1];
  }
  ~Pipe() {
    close_read();
    close_write();
  }
  void close_read() {
    if (read_end >= 0) close(read_end);
    read_end = -1;
  }
  void close_write() {
    if (write_end >= 0) close(write_end);
    write_end = -1;
  }
  int read_end = -1;
  int write_end = -1;
};

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> list;
  for (std::string& word : words) list.push_back(word.data());
  list.push_back(nullptr);
  return list;
}

int exit_code_of(int process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

// A child process with pipes for its three streams.
class Child {
 public:
  enum class Stderr { free, held };  // held: the program blocks until each line has been read

  explicit Child(const std::vector<std::string>& arguments,
                 const fs::path& folder = source_folder(), Stderr of_program = Stderr::free)
      : err_(of_program == Stderr::held ? O_DIRECT : 0) {
    // The pipe has one page, and in packet mode (O_DIRECT) each write occupies a whole page.
    if (of_program == Stderr::held && fcntl(err_.write_end, F_SETPIPE_SZ, 1) < 0)
      throw std::runtime_error("no pipe of one page");
    std::vector<std::string> words{kProgram};
    words.insert(words.end(), arguments.begin(), arguments.end());
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in_.read_end, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, out_.write_end, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err_.write_end, STDERR_FILENO);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    const int failed = posix_spawn(&process_, kProgram.c_str(), &actions, nullptr,
                                   pointers(words).data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) throw std::runtime_error("cannot run " + kProgram);
    in_.close_read();
    out_.close_write();
    err_.close_write();
  }

  void give(const std::string& input) {
    // A program that exits early must not kill the test, so SIGPIPE is ignored.
    std::size_t sent = 0;
    while (sent < input.size()) {
      const ssize_t count = write(in_.write_end, input.data() + sent, input.size() - sent);
      if (count <= 0) break;
      sent += static_cast<std::size_t>(count);
    }
    in_.close_write();
  }

  // Reads until both streams end or `mark` appears on stderr.
  void read_until(const std::string& mark) {
    while (out_.read_end >= 0 || err_.read_end >= 0) {
      std::array<pollfd, 2> wait{{{out_.read_end, POLLIN, 0}, {err_.read_end, POLLIN, 0}}};
      poll(wait.data(), 2, -1);
      if (wait[0].revents != 0) take(out_, ran_.out);
      if (wait[1].revents != 0) take(err_, ran_.err);
      if (!mark.empty() && ran_.err.find(mark) != std::string::npos) return;
    }
  }

  void interrupt(int signal) const { kill(process_, signal); }

  Ran finish() {
    read_until("");
    ran_.exit_code = exit_code_of(process_);
    return ran_;
  }

 private:
  static void take(Pipe& pipe, std::string& into) {
    std::array<char, 4096> buffer{};
    const ssize_t count = read(pipe.read_end, buffer.data(), buffer.size());
    if (count <= 0) {
      pipe.close_read();
    } else {
      into.append(buffer.data(), static_cast<std::size_t>(count));
    }
  }

  Pipe in_;
  Pipe out_;
  Pipe err_;
  pid_t process_ = -1;
  Ran ran_;
};

}  // namespace

Ran springlod_run(const std::vector<std::string>& arguments, const std::string& input,
                  const fs::path& folder) {
  std::signal(SIGPIPE, SIG_IGN);
  Child child(arguments, folder);
  child.give(input);
  return child.finish();
}

Ran springlod_interrupted(const std::vector<std::string>& arguments, const std::string& mark,
                          int signal) {
  Child child(arguments, source_folder(), Child::Stderr::held);
  child.give("");
  child.read_until(mark);
  child.interrupt(signal);
  return child.finish();
}

Terminal::Terminal(const std::vector<std::string>& arguments, const fs::path& state_home,
                   const TerminalSetup& setup) {
  const winsize size{setup.rows, setup.columns, 0, 0};
  process_ = forkpty(&terminal_, nullptr, nullptr, &size);
  if (process_ < 0) throw std::runtime_error("no terminal");
  if (process_ > 0) return;
  for (const auto& [name, value] : setup.environment) setenv(name.c_str(), value.c_str(), 1);
  if (!setup.folder.empty() && chdir(setup.folder.c_str()) != 0) _exit(127);
  setenv("XDG_STATE_HOME", state_home.c_str(), 1);
  std::vector<std::string> words{kProgram};
  words.insert(words.end(), arguments.begin(), arguments.end());
  execv(kProgram.c_str(), pointers(words).data());
  _exit(127);
}

Terminal::~Terminal() {
  if (process_ > 0) {
    kill(process_, SIGKILL);
    exit_code_of(process_);
  }
  close(terminal_);
}

void Terminal::type(const std::string& keys) {
  if (write(terminal_, keys.data(), keys.size()) != static_cast<ssize_t>(keys.size()))
    throw std::runtime_error("the terminal takes no keys");
}

bool Terminal::read_more(int timeout_ms) {
  pollfd wait{terminal_, POLLIN, 0};
  if (poll(&wait, 1, timeout_ms) <= 0) return false;
  std::array<char, 4096> buffer{};
  const ssize_t count = read(terminal_, buffer.data(), buffer.size());
  if (count <= 0) return false;
  screen_.append(buffer.data(), static_cast<std::size_t>(count));
  return true;
}

bool Terminal::shows(const std::string& text) {
  while (true) {
    const std::size_t found = screen_.find(text, seen_);
    if (found != std::string::npos) {
      seen_ = found + text.size();
      return true;
    }
    if (!read_more(kPatience)) return false;
  }
}

int Terminal::exit_code() {
  while (read_more(kPatience)) {
  }
  // As a file descriptor, which can be polled with a time limit.
  const int handle = static_cast<int>(syscall(SYS_pidfd_open, process_, 0));
  pollfd end{handle, POLLIN, 0};
  const bool ended = handle >= 0 && poll(&end, 1, kPatience) > 0;
  close(handle);
  return ended ? exit_code_of(std::exchange(process_, -1)) : -1;
}

void Terminal::signal(int number) const {
  kill(process_, number);
}

std::string slurp(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + path.string());
  return {std::istreambuf_iterator<char>(in), {}};
}

void spit(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out) throw std::runtime_error("cannot write " + path.string());
}

std::string obj_of_boxes(const std::vector<BoxPart>& parts, double width) {
  std::string text;
  int first = 0;
  for (const BoxPart& part : parts) {
    text += fmt::format("o {}\n", part.name);
    for (const double z : {0.0, width})
      for (const double y : {0.0, width})
        for (const double x : {part.x0, part.x1}) text += fmt::format("v {} {} {}\n", x, y, z);
    constexpr std::array<std::array<int, 4>, 6> kFaces{
        {{1, 3, 4, 2}, {5, 6, 8, 7}, {1, 2, 6, 5}, {3, 7, 8, 4}, {1, 5, 7, 3}, {2, 4, 8, 6}}};
    for (const auto& f : kFaces)
      text +=
          fmt::format("f {} {} {} {}\n", first + f[0], first + f[1], first + f[2], first + f[3]);
    first += 8;
  }
  return text;
}

void make_bar_asset(const fs::path& asset, double length, const std::vector<std::string>& options) {
  const fs::path mesh = fs::path(asset).replace_extension("obj");
  spit(mesh, obj_of_boxes({{"bar", 0, length}}));
  std::vector<std::string> arguments{"convert", mesh.string(), "-o",       asset.string(), "-q",
                                     "--fast",  "--grouping",  "standard", "--contact",    "nodes"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Ran ran = springlod_run(arguments);
  if (ran.exit_code != 0)
    throw std::runtime_error("cannot make " + asset.string() + ": " + ran.err);
}

std::string obj_of_open_box() {
  std::string text = obj_of_boxes({{"tub", 0, 1}});
  return text.erase(text.find("f 5 6 8 7\n"), 10);
}

}  // namespace springlod::test
