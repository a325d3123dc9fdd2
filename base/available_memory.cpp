#include "base/available_memory.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/error.hpp"

namespace springlod::inline base {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// The number in a file; unlimited for "max", or if there is no file.
double number_in(const std::string& path) {
  std::ifstream file(path);
  double number = 0;
  return file >> number ? number : kUnlimited;
}

/// The number after a label at the start of a line.
std::optional<double> number_after(const std::string& label, const std::string& path) {
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line))
    if (line.starts_with(label)) return std::stod(line.substr(label.size()));
  return std::nullopt;
}

double free_on_machine() {
  constexpr double kKilobyte = 1024;
  const auto kilobytes = number_after("MemAvailable:", "/proc/meminfo");
  return kilobytes ? kKilobyte * *kilobytes : kUnlimited;
}

// In a container, its own control group is the root of what it sees. What it uses includes files
// that were read, which the kernel drops when memory is needed.
double left_in_group() {
  const std::string group = "/sys/fs/cgroup/memory.";
  const double limit = number_in(group + "max");
  if (limit == kUnlimited) return kUnlimited;
  return limit - number_in(group + "current") +
         number_after("inactive_file ", group + "stat").value_or(0);
}

double left_in_address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnlimited;
  const double pages = number_in("/proc/self/statm");
  return static_cast<double>(limit.rlim_cur) - pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

double available_memory() {
  return std::max(0., std::min({free_on_machine(), left_in_group(), left_in_address_space()}));
}

void require_memory(double needed, std::string_view what,
                    const std::function<std::string(double)>& advice) {
  constexpr double kGigabyte = 1e9;
  const double available = available_memory();
  if (needed > available)
    throw InputError(fmt::format("{} {:.3g} GB of memory, and {:.3g} GB are free; {}", what,
                                 needed / kGigabyte, available / kGigabyte, advice(available)));
}

}  // namespace springlod::inline base
