#include "base/available_memory.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/error.hpp"

namespace springlod::inline base {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

double free_on_machine() {
  constexpr double kKilobyte = 1024;
  std::ifstream file("/proc/meminfo");
  std::string line;
  while (std::getline(file, line))
    if (line.starts_with("MemAvailable:"))
      return kKilobyte * std::stod(line.substr(line.find(':') + 1));
  return kUnlimited;
}

/// The number in a file; unlimited for "max", or if there is no file.
double number_in(const std::string& path) {
  std::ifstream file(path);
  double number = 0;
  return file >> number ? number : kUnlimited;
}

// In a container, its own control group is the root of what it sees.
double left_in_group() {
  const double limit = number_in("/sys/fs/cgroup/memory.max");
  return limit < kUnlimited ? limit - number_in("/sys/fs/cgroup/memory.current") : kUnlimited;
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
