#pragma once

namespace springlod::inline base {

/// Processor time that the calling thread has used [s]. Unlike the time of a clock, it does not
/// count the time in which other programs had the processor.
double processor_seconds();

}  // namespace springlod::inline base
