#pragma once

namespace springlod::scripting {

/// Why a running script must stop.
enum class StopCause { none, interrupt, termination, time_limit };

/// While it lives, Ctrl-C (SIGINT), SIGTERM and the end of the time limit only request a stop, so
/// that scripts and computations end in an orderly way; a script can catch this like any other
/// error. A request that nothing has seen within a second ends the process, as does a second
/// signal.
class InterruptHandler {
 public:
  /// `time_limit` in seconds from now; 0: none.
  explicit InterruptHandler(double time_limit = 0);
  ~InterruptHandler();
  InterruptHandler(const InterruptHandler&) = delete;
  InterruptHandler& operator=(const InterruptHandler&) = delete;
};

/// Whether a stop is requested. Who asks has seen the request and stops.
bool interrupt_requested();
StopCause stop_cause();
void clear_interrupt();

/// "interrupted" and the like, as a message of the program; exit code of a process that was
/// stopped.
const char* stop_text(StopCause cause);
int stop_exit_code(StopCause cause);

}  // namespace springlod::scripting
