#include "sweep/worker.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <system_error>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include "base/error.hpp"

namespace springlod::sweep {

namespace {

namespace fs = std::filesystem;

std::pair<Descriptor, Descriptor> connected_sockets() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw IoError(fmt::format("cannot connect with a process: {}", std::strerror(errno)));
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

Descriptor open_log(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  if (error)
    throw IoError(
        fmt::format("cannot make the folder {}: {}", path.parent_path().string(), error.message()));
  constexpr mode_t kMode = 0666;
  Descriptor log = open_file(path, O_WRONLY | O_CREAT | O_APPEND, kMode);
  if (log.number() < 0)
    throw IoError(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
  return log;
}

}  // namespace

Worker::Worker(const fs::path& program, const std::vector<std::string>& arguments, fs::path log,
               const fs::path& folder)
    : Worker(program, arguments, std::move(log), folder, connected_sockets()) {}

Worker::Worker(const fs::path& program, const std::vector<std::string>& arguments, fs::path log,
               const fs::path& folder, std::pair<Descriptor, Descriptor> ends)
    : log_(std::move(log)), socket_(std::move(ends.first)), lines_(socket_.number()) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw IoError(
        fmt::format("{} is missing, the folder in which the plan was made", folder.string()));
  const Descriptor printed = open_log(log_);
  process_ = start_program(
      program, arguments,
      {.output = printed.number(), .errors = printed.number(), .extra = ends.second.number()},
      folder);
}

// It stops at once: a unit in work counts as not run.
Worker::~Worker() {
  if (process_ == 0) return;
  socket_.close();
  ::kill(process_, SIGTERM);
  using namespace std::chrono_literals;
  constexpr std::chrono::milliseconds kPatience = 5s, kLook = 10ms;
  for (auto waited = 0ms; waited < kPatience; waited += kLook) {
    if (::waitpid(process_, nullptr, WNOHANG) != 0) return;
    std::this_thread::sleep_for(kLook);
  }
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

void Worker::send(const Order& order) {
  send_line(socket_.number(), line_of(order));  // its end is seen when it is read from
}

std::optional<Report> Worker::take_report() {
  while (const auto line = lines_.take()) {
    if (const auto report = report_of(*line)) return report;
    if (const auto error = error_of(*line)) error_ = *error;
  }
  return std::nullopt;
}

void Worker::leave() {
  socket_.close();
  wait();
}

ProcessEnd Worker::wait() {
  return wait_for_program(std::exchange(process_, 0));
}

}  // namespace springlod::sweep
