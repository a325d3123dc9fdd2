#pragma once

#include "bench/subjects.hpp"

namespace springlod::bench {

/// Registers benchmarks of what can be read off a body between its steps, under "look/". Each also
/// measures the step itself, on one thread and without contacts. Counters: times divided by the
/// time of a step.
void register_looks(Subjects& subjects);

}  // namespace springlod::bench
