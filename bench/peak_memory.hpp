#pragma once

#include <cstddef>

namespace springlod::bench {

/// Gives freed memory back to the system and starts the high-water mark anew from what is in use
/// now. False where the system does not allow that: then the mark is that of the whole process.
bool reset_peak_memory();
/// Most memory the process ever held since then (VmHWM of Linux): program, base and all [bytes].
std::size_t peak_memory();

}  // namespace springlod::bench
