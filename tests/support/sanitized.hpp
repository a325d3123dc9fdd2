#pragma once

namespace springlod::test {

/// Whether a sanitizer is compiled in that reserves terabytes of address space: limits of memory
/// cannot be tested then.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace springlod::test
