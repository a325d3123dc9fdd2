#include "scripting/engine/repl.hpp"

#include <algorithm>
#include <cerrno>
#include <clocale>
#include <cstdio>
#include <cwchar>
#include <iostream>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <histedit.h>
#include <lua.hpp>
#include <poll.h>
#include <unistd.h>

#include "scripting/engine/history.hpp"
#include "scripting/engine/interrupt.hpp"
#include "scripting/engine/paths.hpp"
#include "scripting/engine/prompt_words.hpp"

namespace springlod::scripting {

namespace {

// Timeout of a wait for a key [ms]: bounds the delay of a Ctrl-C that arrives just before the wait
// or on another thread.
constexpr int kInterruptWait = 100;

enum class Input { line, interrupted, closed };

// Reads lines with editing, history and completion through libedit's native interface, which has no
// global state, unlike its readline emulation.
class LineEditor {
 public:
  explicit LineEditor(ScriptState& state) : state_(state) {
    std::setlocale(LC_CTYPE, "");
    edit_ = el_init("springlod", stdin, stdout, stderr);
    el_set(edit_, EL_CLIENTDATA, this);
    el_set(edit_, EL_PROMPT, &LineEditor::give_prompt);
    el_set(edit_, EL_EDITOR, "emacs");
    el_set(edit_, EL_SIGNAL, 0);
    el_set(edit_, EL_GETCFN, &LineEditor::read_key);
    el_set(edit_, EL_HIST, history, history_.handle());
    // The narrow-character form, el_set, leaks two copies of its strings.
    el_wset(edit_, EL_ADDFN, L"complete-name", L"completes a name", &LineEditor::complete);
    el_set(edit_, EL_BIND, "^I", "complete-name", nullptr);
    el_set(edit_, EL_BIND, "^R", "em-inc-search-prev", nullptr);
  }
  ~LineEditor() { el_end(edit_); }
  LineEditor(const LineEditor&) = delete;
  LineEditor& operator=(const LineEditor&) = delete;

  /// `earlier`: the lines of the chunk so far.
  Input read(const char* prompt, const std::string& earlier, std::string& line) {
    prompt_ = prompt;
    earlier_ = earlier;
    int count = 0;
    // By default libedit prepares the terminal after it prints the prompt; a Ctrl-D in between
    // would be lost.
    el_set(edit_, EL_PREP_TERM, 1);
    const char* text = el_gets(edit_, &count);
    if (interrupt_requested()) return Input::interrupted;
    if (text == nullptr || count <= 0) return Input::closed;
    line.assign(text, static_cast<std::size_t>(count));
    while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.pop_back();
    return Input::line;
  }

  void remember(const std::string& chunk) { history_.add(chunk); }

 private:
  static LineEditor& self(EditLine* edit) {
    LineEditor* editor = nullptr;
    el_get(edit, EL_CLIENTDATA, &editor);
    return *editor;
  }

  static char* give_prompt(EditLine* edit) { return const_cast<char*>(self(edit).prompt_); }

  // One character from the terminal; -1 after Ctrl-C, which ends el_gets.
  static int read_key(EditLine* /*edit*/, wchar_t* key) {
    std::mbstate_t partial{};
    while (true) {
      if (interrupt_requested()) return -1;
      pollfd terminal{STDIN_FILENO, POLLIN, 0};
      const int ready = poll(&terminal, 1, kInterruptWait);
      if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
      char byte = 0;
      const ssize_t count = ::read(STDIN_FILENO, &byte, 1);
      if (count == 0) return 0;
      if (count < 0) return -1;
      const std::size_t length = std::mbrtowc(key, &byte, 1, &partial);
      if (length == static_cast<std::size_t>(-2)) continue;  // more bytes of the character follow
      if (length == static_cast<std::size_t>(-1)) {          // invalid in this encoding: skip it
        partial = {};
        continue;
      }
      return 1;
    }
  }

  static unsigned char complete(EditLine* edit, int /*key*/) {
    const LineInfo* line = el_line(edit);
    const std::string_view before(line->buffer,
                                  static_cast<std::size_t>(line->cursor - line->buffer));
    const Completions found =
        completions(self(edit).state_, self(edit).earlier_ + "\n" + std::string(before));
    if (found.names.empty()) return CC_REFRESH_BEEP;
    if (found.colon) {
      const auto typed = static_cast<int>(found.typed.size());
      el_deletestr(edit, typed + 1);
      el_insertstr(edit, (":" + found.typed).c_str());
    }
    std::string rest = common_start(found.names).substr(found.typed.size());
    if (found.names.size() == 1) rest += found.ending;
    if (!rest.empty()) {
      el_insertstr(edit, rest.c_str());
      return CC_REFRESH;
    }
    if (found.names.size() == 1 || found.colon) return CC_REFRESH;
    fmt::print("\n{}\n", fmt::join(found.names, "  "));
    std::fflush(stdout);
    return CC_REDISPLAY;
  }

  static std::string common_start(const std::vector<std::string>& names) {
    std::string common = names.front();
    for (const std::string& name : names) {
      const auto end = std::mismatch(common.begin(), common.end(), name.begin(), name.end()).first;
      common.erase(end, common.end());
    }
    return common;
  }

  ScriptState& state_;
  EditLine* edit_ = nullptr;
  PromptHistory history_{history_file()};
  const char* prompt_ = "";
  std::string earlier_;
};

// Reads lines until they form a complete chunk, and evaluates the chunk.
class Prompt {
 public:
  explicit Prompt(ScriptState& state) : state_(state) {
    if (isatty(STDIN_FILENO) != 0) editor_.emplace(state);
  }

  // Returns false at the end of the input or of the session.
  bool turn() {
    std::string line;
    switch (read(chunk_.empty() ? "> " : ">> ", line)) {
      case Input::closed:
        if (editor_) fmt::print("\n");
        return false;
      case Input::interrupted:
        fmt::print("\n");
        std::fflush(stdout);
        if (stop_cause() != StopCause::interrupt) return false;
        chunk_.clear();
        clear_interrupt();
        return true;
      case Input::line:
        break;
    }
    if (chunk_.empty()) {
      if (asks_to_leave(state_, line)) return false;
      std::string answer = shell_command_answer(state_, line);
      if (answer.empty()) answer = unknown_topic_answer(state_, line);
      if (!answer.empty()) {
        if (editor_) editor_->remember(line);
        fmt::print(stderr, "{}\n", answer);
        return true;
      }
    }
    chunk_ += chunk_.empty() ? line : "\n" + line;
    if (chunk_.find_first_not_of(" \t\n") == std::string::npos) {
      chunk_.clear();
      return true;
    }
    if (needs_more_lines(state_, chunk_)) return true;
    // Before it runs, because it may end the process.
    if (editor_) editor_->remember(chunk_);
    const Reply reply = evaluate(state_, chunk_of(state_, chunk_));
    if (!reply.error.empty()) fmt::print(stderr, "{}\n", reply.error);
    if (const std::string hint = missing_table_hint(state_, reply.error); !hint.empty())
      fmt::print(stderr, "{}\n", hint);
    if (reply.error.empty()) warn_of_lost_local();
    chunk_.clear();
    return !interrupt_requested();
  }

 private:
  Input read(const char* prompt, std::string& line) {
    if (editor_) return editor_->read(prompt, chunk_, line);
    return std::getline(std::cin, line) ? Input::line : Input::closed;
  }

  // Once in a session: who knows it does not need it again.
  void warn_of_lost_local() {
    if (warned_of_local_) return;
    const std::string hint = lost_local_hint(state_, chunk_);
    if (hint.empty()) return;
    fmt::print(stderr, "{}\n", hint);
    warned_of_local_ = true;
  }

  ScriptState& state_;
  std::optional<LineEditor> editor_;
  std::string chunk_;
  bool warned_of_local_ = false;
};

}  // namespace

StopCause run_prompt(ScriptState& state) {
  lua_State* L = state.lua();
  clear_interrupt();  // of a script that ran before
  // Loads the module at the prompt; scripts load it explicitly.
  state.run_text("s = require \"springlod\"", "prompt", {});
  lua_settop(L, 0);
  if (isatty(STDIN_FILENO) != 0)
    fmt::print(
        "springlod {}: Lua 5.4 with s = require \"springlod\"; help() lists all functions, Tab "
        "completes, exit leaves\n",
        version());
  Prompt prompt(state);
  while (prompt.turn()) {
  }
  return interrupt_requested() ? stop_cause() : StopCause::none;
}

}  // namespace springlod::scripting
