#pragma once

#include <cstdint>
#include <optional>
#include <string>

// The lines that run_units and serve_units send each other.

namespace springlod::sweep {

/// To a worker: run units [first, end).
struct Order {
  std::uint64_t first = 0;
  std::uint64_t end = 0;
};

/// From a worker.
struct Report {
  enum class Kind : char {
    ready = 'r',   ///< waits for an order
    begun = 'b',   ///< runs `unit` for the `number`-th time
    done = 'd',    ///< has kept the result of `unit`
    failed = 'f',  ///< has kept the failure of `unit`
  };
  Kind kind = Kind::ready;
  std::uint64_t unit = 0;
  int number = 0;
};

/// With a line feed.
std::string line_of(const Order& order);
std::string line_of(const Report& report);
/// From a worker that cannot go on: why. A log on a full disk would not tell.
std::string line_of_error(const std::string& message);
/// Of a line without its line feed; nothing if it is none.
std::optional<Order> order_of(const std::string& line);
std::optional<Report> report_of(const std::string& line);
std::optional<std::string> error_of(const std::string& line);

/// Sends all of a line. Returns whether the other end is open.
bool send_line(int socket, const std::string& line);

/// The lines that arrive at a socket, read as they come.
class Lines {
 public:
  explicit Lines(int socket) : socket_(socket) {}
  /// Waits for the next line; nothing at the end.
  std::optional<std::string> next();
  /// A line that has arrived already.
  std::optional<std::string> take();
  /// Reads what has arrived, waiting for something if nothing has. Returns false at the end.
  bool read_more();

 private:
  int socket_;
  std::string text_;
};

}  // namespace springlod::sweep
