#pragma once

namespace springlod::scripting {

/// Handles Ctrl-C. A signal handler can only set a flag; the flag is global to the process.
///
/// During its lifetime, SIGINT sets the flag. A second SIGINT while the flag is set terminates the
/// program, because some calls, such as a long string.find, cannot be interrupted.
class InterruptHandler {
 public:
  InterruptHandler();
  ~InterruptHandler();
  InterruptHandler(const InterruptHandler&) = delete;
  InterruptHandler& operator=(const InterruptHandler&) = delete;
};

bool interrupt_requested();
void clear_interrupt();

}  // namespace springlod::scripting
