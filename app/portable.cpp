#include "app/portable.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include <Eigen/Core>
#include <fmt/format.h>
#include <unistd.h>

#include "base/error.hpp"
#include "elastic/solver/dense_kernels.hpp"
#include "sim/fast/vector_target.hpp"

namespace springlod::app {

namespace {

constexpr const char* kBlasChoice = "OPENBLAS_CORETYPE";
// OpenBLAS's kernels for AVX2 and for SSE4.2. Unlike those of older processors, they take no block
// size from the cache of the machine.
constexpr const char* kAvx2Blas = "Haswell";
constexpr const char* kSse4Blas = "Nehalem";
// The C library rounds differently with fused multiply-add. Since glibc 2.33 the name is FMA.
constexpr const char* kNoFusing = "glibc.cpu.hwcaps=-FMA,-FMA4,-FMA_Usable,-FMA4_Usable";

std::string value_of(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

bool has_sse42() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("sse4.2") != 0;
#else
  return false;
#endif
}

bool has_avx2() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
#else
  return false;
#endif
}

/// Starts this program again. Returns only if it cannot be.
void start_again(char** argv) {
  execv("/proc/self/exe", argv);
}

}  // namespace

void fix_block_sizes() {
  constexpr std::ptrdiff_t kFirst = 32 << 10, kSecond = 256 << 10, kThird = 2 << 20;  // [bytes]
  Eigen::setCpuCacheSizes(kFirst, kSecond, kThird);
}

void fix_blas_kernels(char** argv) {
  const std::string asked = value_of(kBlasChoice);
  if (has_avx2()) {
    if (!asked.empty() || std::string_view(elastic::blas_kernels()) == kAvx2Blas) return;
    setenv(kBlasChoice, kAvx2Blas, 1);
  } else {
    // A cluster passes the choice on from the machine where it was made.
    if (asked != kAvx2Blas) return;
    unsetenv(kBlasChoice);
  }
  start_again(argv);
}

void make_portable(char** argv) {
  if (!has_sse42())
    throw InputError("--portable needs an x86-64 processor with SSE4.2, which this one has not");
  sim::use_portable_kernels();
  const std::string tunables = value_of("GLIBC_TUNABLES");
  const bool fuses = !tunables.ends_with(kNoFusing);
  if (!fuses && value_of(kBlasChoice) == kSse4Blas) return;
  setenv(kBlasChoice, kSse4Blas, 1);
  if (fuses)  // the last of several settings counts
    setenv("GLIBC_TUNABLES", (tunables.empty() ? kNoFusing : tunables + ":" + kNoFusing).c_str(),
           1);
  start_again(argv);
  throw IoError(fmt::format("--portable cannot start the program again: {}", std::strerror(errno)));
}

}  // namespace springlod::app
