#pragma once

namespace springlod::inline base {

/// Memory that this process can still take [bytes]: what the machine has free, or less if a limit
/// of its control group or of its address space (ulimit -v) leaves less. Infinity where the system
/// does not say.
double available_memory();

}  // namespace springlod::inline base
