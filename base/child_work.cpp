#include "base/child_work.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <new>
#include <string_view>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/descriptor.hpp"

namespace springlod::inline base {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kAskEvery = 100;             // interval of looks at progress and clock [ms]
constexpr std::size_t kChunk = 1U << 16U;  // of the pipe, its capacity on Linux [bytes]

// Libraries put what they find in a damaged file into their messages [characters].
constexpr std::size_t kLongestMessage = 2000;

// The first byte of what a child sends says what the others are.
enum class Kind : char {
  result = 'r',
  input_error = 'i',
  io_error = 'o',
  memory = 'm',
  other = 'e'
};

// ---------------------------------------------------------------- in the child

void limit(int resource, std::uint64_t most) {
  rlimit limits{};
  getrlimit(static_cast<__rlimit_resource>(resource), &limits);
  limits.rlim_cur = std::min<rlim_t>(most, limits.rlim_max);
  setrlimit(static_cast<__rlimit_resource>(resource), &limits);
}

// The address space of the process now, from Linux [bytes].
std::uint64_t address_space() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void apply(const ChildLimits& limits) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_CPU, static_cast<std::uint64_t>(std::ceil(limits.seconds)));
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  // Sanitizers reserve terabytes of address space.
  limit(RLIMIT_AS, address_space() + limits.memory);
#endif
}

void be_quiet() {
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, number);
}

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

bool send(int descriptor, Kind kind, std::string_view bytes) {
  if (kind != Kind::result) bytes = bytes.substr(0, kLongestMessage);
  const char first = static_cast<char>(kind);
  return write_all(descriptor, {&first, 1}) && write_all(descriptor, bytes);
}

bool work_and_send(int descriptor, const std::function<std::string()>& work) {
  try {
    return send(descriptor, Kind::result, work());
  } catch (const InputError& error) {
    return send(descriptor, Kind::input_error, error.what());
  } catch (const IoError& error) {
    return send(descriptor, Kind::io_error, error.what());
  } catch (const std::bad_alloc&) {
    return send(descriptor, Kind::memory, {});
  } catch (const std::exception& error) {
    return send(descriptor, Kind::other, error.what());
  } catch (...) {
    return send(descriptor, Kind::other, "an unknown error");
  }
}

[[noreturn]] void be_child(int descriptor, pid_t parent, const std::function<std::string()>& work,
                           const ChildLimits& limits) {
  // Ctrl-C goes to all processes of the terminal; the parent decides what it means.
  std::signal(SIGINT, SIG_IGN);
  for (const int signal : {SIGTERM, SIGXCPU, SIGALRM}) std::signal(signal, SIG_DFL);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // it has ended before the line above
  be_quiet();
  apply(limits);
  _exit(work_and_send(descriptor, work) ? 0 : 1);
}

// ---------------------------------------------------------------- in the parent

/// Ends the child if it is still running, and waits for it.
class Child {
 public:
  explicit Child(pid_t number) : number_(number) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (number_ <= 0) return;
    ::kill(number_, SIGKILL);
    wait();
  }
  /// Status as of waitpid.
  int wait() {
    int status = 0;
    while (::waitpid(number_, &status, 0) < 0 && errno == EINTR) {
    }
    number_ = 0;
    return status;
  }

 private:
  pid_t number_;
};

std::string too_long(const ChildLimits& limits) {
  return fmt::format("took longer than {:g} s", limits.seconds);
}

std::string too_large(const ChildLimits& limits) {
  return fmt::format("needed more than {:.3g} GB of memory",
                     static_cast<double>(limits.memory) / (1U << 30U));
}

// All that the child sends, or as much as it does before it ends.
std::string receive(int descriptor, const ChildLimits& limits, Progress* progress) {
  const auto end = Clock::now() + std::chrono::duration<double>(2 * limits.seconds);
  std::string bytes;
  std::array<char, kChunk> chunk{};
  for (;;) {
    pollfd wanted{descriptor, POLLIN, 0};
    const int ready = ::poll(&wanted, 1, kAskEvery);
    if (progress != nullptr) progress->advance(0);
    if (Clock::now() > end) throw ChildFailure(too_long(limits));
    if (ready <= 0) continue;
    const ssize_t count = ::read(descriptor, chunk.data(), chunk.size());
    if (count == 0 || (count < 0 && errno != EINTR)) return bytes;
    if (count > 0) bytes.append(chunk.data(), static_cast<std::size_t>(count));
    if (bytes.size() > limits.result) throw ChildFailure("gave a result that is too large");
  }
}

[[noreturn]] void throw_ending(int status, const ChildLimits& limits) {
  if (!WIFSIGNALED(status)) throw ChildFailure("ended without a result");
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU) throw ChildFailure(too_long(limits));
  // The kernel kills what exceeds the memory of the machine.
  if (signal == SIGKILL) throw ChildFailure("was ended by the system, perhaps for its memory");
  throw ChildFailure(fmt::format("crashed ({})", strsignal(signal)));
}

std::string result_of(std::string bytes, int status, const ChildLimits& limits) {
  if (bytes.empty() || !WIFEXITED(status) || WEXITSTATUS(status) != 0) throw_ending(status, limits);
  const auto kind = static_cast<Kind>(bytes.front());
  bytes.erase(0, 1);
  switch (kind) {
    case Kind::result:
      return bytes;
    case Kind::input_error:
      throw InputError(bytes);
    case Kind::io_error:
      throw IoError(bytes);
    case Kind::memory:
      throw ChildFailure(too_large(limits));
    case Kind::other:
      break;
  }
  throw ChildFailure(fmt::format("failed ({})", bytes));
}

}  // namespace

std::string run_in_child(const std::function<std::string()>& work, const ChildLimits& limits,
                         Progress* progress) {
  Pipe pipe = make_pipe();
  const pid_t parent = ::getpid();
  const pid_t number = ::fork();
  if (number < 0)
    throw IoError(fmt::format("cannot start a child process: {}", std::strerror(errno)));
  if (number == 0) {
    pipe.reading.close();
    be_child(pipe.writing.number(), parent, work, limits);
  }
  Child child(number);
  pipe.writing.close();  // otherwise reading would never reach its end
  std::string bytes = receive(pipe.reading.number(), limits, progress);
  return result_of(std::move(bytes), child.wait(), limits);
}

}  // namespace springlod::inline base
