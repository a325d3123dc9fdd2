// The position of the cursor in a chunk that is being typed.

#include "scripting/engine/cursor.hpp"

#include <algorithm>
#include <cctype>

namespace springlod::scripting {

namespace {

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  Cursor scan() {
    while (at_ < text_.size() && !cursor_.string && !cursor_.comment) step();
    return std::move(cursor_);
  }

 private:
  void step() {
    const char c = text_[at_];
    if (std::isspace(static_cast<unsigned char>(c)) != 0) {
      ++at_;
    } else if (text_.substr(at_).starts_with("--")) {
      skip_comment();
    } else if (c == '"' || c == '\'') {
      skip_string(c);
      before_ = "";
    } else if (c == '[' && long_bracket(at_) > 0) {
      skip_long(at_);
      before_ = "";
    } else if (is_name_letter(c)) {
      take_path();
    } else {
      take_sign(c);
    }
  }

  // Length of "[[" or "[==[" at `at`; 0 if there is none.
  std::size_t long_bracket(std::size_t at) const {
    std::size_t end = at + 1;
    while (end < text_.size() && text_[end] == '=') ++end;
    return end < text_.size() && text_[end] == '[' ? end + 1 - at : 0;
  }

  // Returns false if the text ends before the bracket is closed.
  bool skip_long(std::size_t at) {
    const std::size_t length = long_bracket(at);
    std::string close(length, '=');
    close.front() = close.back() = ']';
    const std::size_t end = text_.find(close, at + length);
    if (end == std::string_view::npos) {
      cursor_.string = at + length;
      cursor_.quote = '[';
      return false;
    }
    at_ = end + length;
    return true;
  }

  void skip_comment() {
    const std::size_t start = at_ + 2;
    if (start < text_.size() && text_[start] == '[' && long_bracket(start) > 0) {
      if (!skip_long(start)) {
        cursor_.string.reset();
        cursor_.comment = true;
      }
      return;
    }
    const std::size_t end = text_.find('\n', start);
    cursor_.comment = end == std::string_view::npos;
    if (!cursor_.comment) at_ = end;
  }

  void skip_string(char quote) {
    const std::size_t start = ++at_;
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\\') {
        ++at_;
      } else if (text_[at_] == quote || text_[at_] == '\n') {
        ++at_;
        return;
      }
    }
    cursor_.string = start;
    cursor_.quote = quote;
    if (!before_.empty()) cursor_.open.push_back({.callee = std::string(before_), .start = start});
  }

  // A name, number or path such as s.simplify or m:node.
  void take_path() {
    const std::size_t start = at_;
    while (at_ < text_.size() &&
           (is_name_letter(text_[at_]) || text_[at_] == '.' || text_[at_] == ':'))
      ++at_;
    before_ = text_.substr(start, at_ - start);
    if (std::find(kKeywords.begin(), kKeywords.end(), before_) != kKeywords.end()) before_ = "";
  }

  void take_sign(char c) {
    const bool comparison =
        c == '=' &&
        ((at_ > 0 && std::string_view("=<>~").find(text_[at_ - 1]) != std::string_view::npos) ||
         (at_ + 1 < text_.size() && text_[at_ + 1] == '='));
    ++at_;
    std::vector<OpenBracket>& open = cursor_.open;
    if (c == '(' || c == '{' || c == '[') {
      open.push_back({.bracket = c, .callee = c == '[' ? "" : std::string(before_), .start = at_});
    } else if (c == ')' || c == '}' || c == ']') {
      if (!open.empty()) open.pop_back();
    } else if (!open.empty() && (c == ',' || c == ';')) {
      ++open.back().commas;
      open.back().key.clear();
      open.back().start = at_;
    } else if (!open.empty() && c == '=' && !comparison && open.back().bracket == '{') {
      open.back().key = before_;
      open.back().keys.emplace_back(before_);
      open.back().start = at_;
    }
    before_ = "";
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::string_view before_;  // the path that the scan has just passed, else empty
  Cursor cursor_;
};

}  // namespace

bool is_name_letter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

Cursor cursor_in(std::string_view text) {
  return Scanner(text).scan();
}

}  // namespace springlod::scripting
