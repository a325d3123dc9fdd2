#pragma once

#include <cstddef>

namespace springlod::inline base {

/// Asks for memory ahead of its use. A hint: any address is allowed.
inline void prefetch(const void* address) {
  __builtin_prefetch(address);
  // Else g++ takes functions that do nothing but this for pure ones, and drops calls of them.
  asm volatile("");
}

/// The same for all from `first` up to `last`.
template <class T>
void prefetch(const T* first, const T* last) {
  constexpr std::ptrdiff_t kCacheLine = 64;  // bytes; of all x86-64 and most other processors
  const auto* end = reinterpret_cast<const char*>(last);
  for (const auto* line = reinterpret_cast<const char*>(first); line < end; line += kCacheLine)
    prefetch(line);
}

}  // namespace springlod::inline base
