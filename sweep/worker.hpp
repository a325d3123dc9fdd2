#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

#include "base/descriptor.hpp"
#include "base/subprocess.hpp"
#include "sweep/work_lines.hpp"

namespace springlod::sweep {

/// A process that runs units for this one. It is ended with this object.
class Worker {
 public:
  /// It runs in `folder`; what it prints goes to `log`. Throws IoError.
  Worker(const std::filesystem::path& program, const std::vector<std::string>& arguments,
         std::filesystem::path log, const std::filesystem::path& folder);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  int socket() const { return socket_.number(); }
  const std::filesystem::path& log() const { return log_; }
  void send(const Order& order);
  /// Reads what it has reported. Returns false if it has ended.
  bool read_more() { return lines_.read_more(); }
  std::optional<Report> take_report();
  /// Why it could not go on; empty if it has not said.
  const std::string& error() const { return error_; }
  /// After its end.
  ProcessEnd wait();
  /// Lets it end by itself, while it waits for an order.
  void leave();

 private:
  Worker(const std::filesystem::path& program, const std::vector<std::string>& arguments,
         std::filesystem::path log, const std::filesystem::path& folder,
         std::pair<Descriptor, Descriptor> ends);

  std::filesystem::path log_;
  Descriptor socket_;
  Lines lines_;
  std::string error_;
  pid_t process_ = 0;  // 0: waited for
};

}  // namespace springlod::sweep
