#include "bench/peak_memory.hpp"

#include <fstream>
#include <string>

#include <malloc.h>

namespace springlod::bench {

bool reset_peak_memory() {
  malloc_trim(0);
  std::ofstream clear("/proc/self/clear_refs");
  clear << "5" << std::flush;  // proc(5): 5 resets the peak resident set size
  return clear.good();
}

std::size_t peak_memory() {
  constexpr std::size_t kKibibyte = 1024;
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == "VmHWM:") {
      std::size_t kibibytes = 0;
      status >> kibibytes;
      return kKibibyte * kibibytes;
    }
  return 0;
}

}  // namespace springlod::bench
