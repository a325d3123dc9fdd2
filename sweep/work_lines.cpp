#include "sweep/work_lines.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <string_view>

#include <fmt/format.h>
#include <sys/socket.h>

namespace springlod::sweep {

namespace {
constexpr std::string_view kError = "error ";
}

std::string line_of(const Order& order) {
  return fmt::format("{} {}\n", order.first, order.end);
}

std::string line_of(const Report& report) {
  return fmt::format("{} {} {}\n", static_cast<char>(report.kind), report.unit, report.number);
}

std::string line_of_error(const std::string& message) {
  std::string line = std::string(kError) + message;
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line + "\n";
}

std::optional<Order> order_of(const std::string& line) {
  unsigned long long first = 0, end = 0;
  if (std::sscanf(line.c_str(), "%llu %llu", &first, &end) != 2) return std::nullopt;
  return Order{first, end};
}

std::optional<Report> report_of(const std::string& line) {
  char kind = 0;
  unsigned long long unit = 0;
  int number = 0;
  if (std::sscanf(line.c_str(), "%c %llu %d", &kind, &unit, &number) != 3 ||
      std::string_view("rbdf").find(kind) == std::string_view::npos)
    return std::nullopt;
  return Report{static_cast<Report::Kind>(kind), unit, number};
}

std::optional<std::string> error_of(const std::string& line) {
  if (!line.starts_with(kError)) return std::nullopt;
  return line.substr(kError.size());
}

bool send_line(int socket, const std::string& line) {
  std::string_view rest = line;
  while (!rest.empty()) {
    const ssize_t sent = ::send(socket, rest.data(), rest.size(), MSG_NOSIGNAL);
    if (sent > 0)
      rest.remove_prefix(static_cast<std::size_t>(sent));
    else if (errno != EINTR)
      return false;
  }
  return true;
}

std::optional<std::string> Lines::take() {
  const std::size_t end = text_.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = text_.substr(0, end);
  text_.erase(0, end + 1);
  return line;
}

bool Lines::read_more() {
  std::array<char, 4096> buffer{};
  ssize_t got = 0;
  do got = ::recv(socket_, buffer.data(), buffer.size(), 0);
  while (got < 0 && errno == EINTR);
  if (got > 0) text_.append(buffer.data(), static_cast<std::size_t>(got));
  return got > 0;
}

std::optional<std::string> Lines::next() {
  for (;;) {
    if (auto line = take()) return line;
    if (!read_more()) return std::nullopt;
  }
}

}  // namespace springlod::sweep
