#include "scripting/engine/interrupt.hpp"

#include <atomic>
#include <cmath>
#include <csignal>
#include <cstring>
#include <ctime>

#include <unistd.h>

namespace springlod::scripting {

namespace {

// From the request of a stop to the end of a process in which nothing has seen it [s].
constexpr unsigned kGrace = 1;
// The signal of the timer of the time limit; the system sends it for limits on processor time.
constexpr int kTimeSignal = SIGXCPU;

std::atomic<StopCause> requested{StopCause::none};
std::atomic<bool> seen{false};
static_assert(std::atomic<StopCause>::is_always_lock_free, "set in a signal handler");

StopCause cause_of(int signal) {
  if (signal == SIGINT) return StopCause::interrupt;
  return signal == SIGTERM ? StopCause::termination : StopCause::time_limit;
}

void put(const char* text) {
  // A failure cannot be reported any more.
  [[maybe_unused]] const auto count = write(STDERR_FILENO, text, std::strlen(text));
}

[[noreturn]] void end_process() {
  const StopCause cause = requested.load();
  put("\nspringlod: ");
  put(stop_text(cause));
  put("\n");
  _exit(stop_exit_code(cause));
}

extern "C" void on_stop(int signal) {
  auto none = StopCause::none;
  if (requested.compare_exchange_strong(none, cause_of(signal))) {
    seen = false;
    alarm(kGrace);
  } else if (signal != kTimeSignal) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

extern "C" void on_grace_over(int /*signal*/) {
  if (requested.load() != StopCause::none && !seen.load()) end_process();
}

void handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  action.sa_flags = 0;  // no SA_RESTART: a prompt that waits for a key must notice the signal
  sigaction(signal, &action, nullptr);
}

void start_timer(double seconds) {
  sigevent event{};
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = kTimeSignal;
  timer_t timer{};
  if (timer_create(CLOCK_MONOTONIC, &event, &timer) != 0) return;
  constexpr double kNano = 1e9;
  const double whole = std::floor(seconds);
  itimerspec when{};
  when.it_value.tv_sec = static_cast<time_t>(whole);
  when.it_value.tv_nsec = static_cast<long>((seconds - whole) * kNano);
  timer_settime(timer, 0, &when, nullptr);
}

}  // namespace

InterruptHandler::InterruptHandler(double time_limit) {
  handle(SIGINT, on_stop);
  handle(SIGTERM, on_stop);
  handle(kTimeSignal, on_stop);
  handle(SIGALRM, on_grace_over);
  if (time_limit > 0) start_timer(time_limit);
}

InterruptHandler::~InterruptHandler() {
  alarm(0);
  for (const int signal : {SIGINT, SIGTERM, SIGALRM}) std::signal(signal, SIG_DFL);
  std::signal(kTimeSignal, SIG_IGN);  // the script is done
}

bool interrupt_requested() {
  if (requested.load(std::memory_order_relaxed) == StopCause::none) return false;
  seen.store(true, std::memory_order_relaxed);
  return true;
}

StopCause stop_cause() {
  return requested.load();
}

void clear_interrupt() {
  requested.store(StopCause::none);
}

const char* stop_text(StopCause cause) {
  switch (cause) {
    case StopCause::termination:
      return "terminated";
    case StopCause::time_limit:
      return "stopped: the time limit is over (--time-limit)";
    case StopCause::interrupt:
    case StopCause::none:
      break;
  }
  return "interrupted";
}

int stop_exit_code(StopCause cause) {
  constexpr int kSignalled = 128;  // the convention of shells
  if (cause == StopCause::time_limit) return 1;
  return kSignalled + (cause == StopCause::termination ? SIGTERM : SIGINT);
}

}  // namespace springlod::scripting
