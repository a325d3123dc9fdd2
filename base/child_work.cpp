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
#include <optional>
#include <span>
#include <string_view>
#include <utility>

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

constexpr int kAskEvery = 100;  // interval of looks at progress and clock [ms]
// The largest pipe that Linux gives to everyone. With its usual 64 kB, both processes wait for each
// other 16 times as often, which costs more than the copying [bytes].
constexpr int kPipeSize = 1 << 20;

// Libraries put what they find in a damaged file into their messages [characters].
constexpr std::size_t kLongestMessage = 2000;

// What a child sends: a header, then bytes.
enum class Kind : char {
  result = 'r',
  input_error = 'i',
  io_error = 'o',
  memory = 'm',
  other = 'e'
};
struct Header {
  Kind kind = Kind::other;
  std::uint64_t size = 0;  // of the bytes that follow
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
  const Header header{kind, bytes.size()};
  std::array<char, sizeof header> first{};
  std::memcpy(first.data(), &header, sizeof header);
  return write_all(descriptor, {first.data(), first.size()}) && write_all(descriptor, bytes);
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

/// The end of the pipe that the parent reads.
class Receiver {
 public:
  Receiver(int descriptor, const ChildLimits& limits, Progress* progress)
      : descriptor_(descriptor),
        limits_(&limits),
        progress_(progress),
        end_(Clock::now() + std::chrono::duration<double>(2 * limits.seconds)) {}

  /// Fills `bytes`. False if the child ends before.
  bool fill(std::span<char> bytes) {
    while (!bytes.empty()) {
      pollfd wanted{descriptor_, POLLIN, 0};
      const int ready = ::poll(&wanted, 1, kAskEvery);
      if (progress_ != nullptr) progress_->advance(0);
      if (Clock::now() > end_) throw ChildFailure(too_long(*limits_));
      if (ready <= 0) continue;
      const ssize_t count = ::read(descriptor_, bytes.data(), bytes.size());
      if (count == 0 || (count < 0 && errno != EINTR)) return false;
      if (count > 0) bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return true;
  }

 private:
  int descriptor_;
  const ChildLimits* limits_;
  Progress* progress_;
  std::chrono::time_point<Clock, std::chrono::duration<double>> end_;
};

struct Message {
  Kind kind = Kind::other;
  std::string bytes;
};

/// Empty if the child ended without a whole message.
std::optional<Message> receive(Receiver from, const ChildLimits& limits) {
  Header header;
  std::array<char, sizeof header> first{};
  if (!from.fill(first)) return std::nullopt;
  std::memcpy(&header, first.data(), sizeof header);
  if (header.size > limits.result) throw ChildFailure("gave a result that is too large");
  Message message{header.kind, std::string(header.size, '\0')};
  if (!from.fill(message.bytes)) return std::nullopt;
  return message;
}

[[noreturn]] void throw_ending(int status, const ChildLimits& limits) {
  if (!WIFSIGNALED(status)) throw ChildFailure("ended without a result");
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU) throw ChildFailure(too_long(limits));
  // The kernel kills what exceeds the memory of the machine.
  if (signal == SIGKILL) throw ChildFailure("was ended by the system, perhaps for its memory");
  throw ChildFailure(fmt::format("crashed ({})", strsignal(signal)));
}

std::string result_of(Message message, const ChildLimits& limits) {
  switch (message.kind) {
    case Kind::result:
      return std::move(message.bytes);
    case Kind::input_error:
      throw InputError(message.bytes);
    case Kind::io_error:
      throw IoError(message.bytes);
    case Kind::memory:
      throw ChildFailure(too_large(limits));
    case Kind::other:
      break;
  }
  throw ChildFailure(fmt::format("failed ({})", message.bytes));
}

}  // namespace

std::string run_in_child(const std::function<std::string()>& work, const ChildLimits& limits,
                         Progress* progress) {
  Pipe pipe = make_pipe();
  ::fcntl(pipe.writing.number(), F_SETPIPE_SZ, kPipeSize);  // smaller does as well
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
  std::optional<Message> message = receive({pipe.reading.number(), limits, progress}, limits);
  if (!message) throw_ending(child.wait(), limits);
  return result_of(std::move(*message), limits);
}

}  // namespace springlod::inline base
