#pragma once

namespace springlod::scripting {

/// Ctrl-C. A signal handler can only set a flag, so the flag is one for the process.
///
/// While it lives, SIGINT sets the flag; a third SIGINT with the flag still set ends the program
/// (some work, such as one long string.find, cannot be interrupted).
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
