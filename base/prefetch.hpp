#pragma once

#include <cstddef>

namespace springlod::inline base {

/// Prefetches a cache line. This is a hint: any address is allowed.
inline void prefetch(const void* address) {
  __builtin_prefetch(address);
  // Without this line, g++ treats a function that only prefetches as pure and drops calls to it.
  asm volatile("");
}

/// Prefetches all cache lines from `first` up to `last`.
template <class T>
void prefetch(const T* first, const T* last) {
  constexpr std::ptrdiff_t kCacheLine = 64;  // bytes; of all x86-64 and most other processors
  const auto* end = reinterpret_cast<const char*>(last);
  for (const auto* line = reinterpret_cast<const char*>(first); line < end; line += kCacheLine)
    prefetch(line);
}

}  // namespace springlod::inline base
