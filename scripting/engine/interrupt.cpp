#include "scripting/engine/interrupt.hpp"

#include <atomic>
#include <csignal>

namespace springlod::scripting {

namespace {

std::atomic<int> interrupts{0};
static_assert(std::atomic<int>::is_always_lock_free, "set in a signal handler");

extern "C" void on_interrupt(int signal) {
  if (interrupts.fetch_add(1) == 0) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

InterruptHandler::InterruptHandler() {
  struct sigaction action {};
  action.sa_handler = on_interrupt;
  sigemptyset(&action.sa_mask);
  action.sa_flags = 0;  // no SA_RESTART: a prompt that waits for a key must notice the signal
  sigaction(SIGINT, &action, nullptr);
}

InterruptHandler::~InterruptHandler() {
  std::signal(SIGINT, SIG_DFL);
}

bool interrupt_requested() {
  return interrupts.load(std::memory_order_relaxed) > 0;
}
void clear_interrupt() {
  interrupts.store(0);
}

}  // namespace springlod::scripting
