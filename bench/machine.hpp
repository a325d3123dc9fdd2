#pragma once

namespace springlod::bench {

/// Registers measurements of the machine's limits for one thread: memory bandwidth ("machine/read",
/// "machine/read_write": counter ns_per_byte), clock cycle ("machine/cycle": ns_per_cycle, from
/// dependent additions) and throughput of vector instructions ("machine/vectors": ns_per_vector).
void register_machine();

}  // namespace springlod::bench
