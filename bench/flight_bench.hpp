#pragma once

namespace springlod::bench {

/// Registers benchmarks of a step in free flight, as `run` does it, of bodies of several shapes and
/// sizes and of two levels of each, under "flight/". Counters: nodes, springs, ns_per_step, the
/// work of a step (sim::StepWork) and its time by sim::step_time (predicted_ns).
void register_flights();

}  // namespace springlod::bench
