#pragma once

#include <cstddef>

namespace springlod::bench {

/// Returns freed memory to the system and resets the high-water mark to the current use. Returns
/// false if the system does not support it; the mark is then that of the whole process.
bool reset_peak_memory();
/// Peak resident memory of the process since the reset (VmHWM of Linux) [bytes].
std::size_t peak_memory();

}  // namespace springlod::bench
