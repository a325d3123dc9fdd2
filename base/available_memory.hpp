#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace springlod::inline base {

/// Memory that this process can still take [bytes]: what the machine has free, or less if a limit
/// of its control group or of its address space (ulimit -v) leaves less. Infinity where the system
/// does not say.
double available_memory();

/// Throws InputError if `needed` [bytes] is more than available_memory(): "WHAT 9 GB of memory, and
/// 2 GB are free; ADVICE". `what` ends with a verb: "modes: 9 modes of 8 nodes need". `advice` gets
/// what is available [bytes].
void require_memory(double needed, std::string_view what,
                    const std::function<std::string(double)>& advice);

}  // namespace springlod::inline base
