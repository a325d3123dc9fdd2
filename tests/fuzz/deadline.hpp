#pragma once

#include <csignal>
#include <ctime>

#include "scripting/engine/interrupt.hpp"

namespace springlod::fuzz {

/// Sends this process Ctrl-C after a while: long runs are no bugs, but they must end then.
class Deadline {
 public:
  Deadline() {
    sigevent event{};
    event.sigev_notify = SIGEV_SIGNAL;
    event.sigev_signo = SIGINT;
    timer_create(CLOCK_MONOTONIC, &event, &timer_);
    constexpr itimerspec kOnce{{}, {.tv_sec = 1, .tv_nsec = 0}};
    timer_settime(timer_, 0, &kOnce, nullptr);
  }
  Deadline(const Deadline&) = delete;
  Deadline& operator=(const Deadline&) = delete;
  ~Deadline() {
    timer_delete(timer_);
    scripting::clear_interrupt();
  }

 private:
  timer_t timer_{};
};

}  // namespace springlod::fuzz
