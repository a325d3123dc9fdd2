#pragma once

namespace springlod::bench {

/// Registers what a step is held to: how fast memory streams past one thread ("machine/read",
/// "machine/read_write": counter ns_per_byte), how long a cycle is ("machine/cycle": ns_per_cycle,
/// from additions that each wait for the one before), and how many vector instructions a core
/// begins ("machine/vectors": ns_per_vector).
void register_machine();

}  // namespace springlod::bench
