#include "scripting/engine/screen.hpp"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <sys/ioctl.h>
#include <unistd.h>

#include "scripting/engine/interrupt.hpp"

namespace springlod::scripting {

namespace {

bool is_empty(const char* text) {
  return text == nullptr || *text == 0;
}

bool can_page() {
  if (isatty(STDIN_FILENO) == 0 || isatty(STDOUT_FILENO) == 0) return false;
  const char* terminal = std::getenv("TERM");
  return !is_empty(terminal) && std::string_view(terminal) != "dumb";
}

// False if the pager could not be started; a shell then exits with 127.
bool page(const std::string& text) {
  constexpr int kNotFound = 127;
  // As git does: quit if all fits one screen, keep colours, leave the text on the screen. The shell
  // stays silent about a missing `less`.
  const char* command = is_empty(std::getenv("PAGER"))
                            ? "exec 2>/dev/null; LESS=${LESS-FRX} exec less"
                            : "LESS=${LESS-FRX} exec $PAGER";
  std::FILE* pager = popen(command, "w");
  if (pager == nullptr) return false;
  // A pager that is left early closes the pipe.
  const auto broken_pipe = std::signal(SIGPIPE, SIG_IGN);
  std::fputs(text.c_str(), pager);
  const int status = pclose(pager);
  std::signal(SIGPIPE, broken_pipe);
  // Ctrl-C was meant for the pager.
  if (stop_cause() == StopCause::interrupt) clear_interrupt();
  return status != -1 && !(WIFEXITED(status) && WEXITSTATUS(status) == kNotFound);
}

}  // namespace

ScreenSize screen_size() {
  winsize size{};
  if (isatty(STDOUT_FILENO) == 0 || ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0) return {};
  return {size.ws_col, size.ws_row};
}

void show_text(const std::string& text) {
  const std::string lines = text + "\n";
  const auto count = static_cast<std::size_t>(std::count(lines.begin(), lines.end(), '\n'));
  const std::size_t rows = screen_size().rows;
  std::fflush(stdout);
  // One row is the prompt's.
  if (rows > 0 && count >= rows && can_page() && page(lines)) return;
  std::fputs(lines.c_str(), stdout);
  std::fflush(stdout);
}

}  // namespace springlod::scripting
