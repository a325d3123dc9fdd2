#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace springlod::scripting {

inline constexpr std::array<std::string_view, 22> kKeywords{
    "and",      "break",  "do",   "else", "elseif", "end",  "false", "for",
    "function", "goto",   "if",   "in",   "local",  "nil",  "not",   "or",
    "repeat",   "return", "then", "true", "until",  "while"};

/// A bracket before the cursor that is still open, or the call of s.import "...
struct OpenBracket {
  char bracket = '(';               ///< ( { [
  std::string callee{};             ///< "s.simplify" in s.simplify( and s.simplify{; empty: no call
  std::size_t commas = 0;           ///< number of entries before that of the cursor
  std::string key{};                ///< "levels" in {levels = ; of the entry at the cursor
  std::vector<std::string> keys{};  ///< of all entries so far
  std::size_t start = 0;            ///< where the entry's value starts in the text
};

/// What Lua text before the cursor says about the cursor.
struct Cursor {
  std::vector<OpenBracket> open{};      ///< outermost first
  std::optional<std::size_t> string{};  ///< where the text of an open string starts
  char quote = '"';                     ///< of the open string; [ for a long one
  bool comment = false;                 ///< in a comment
};
Cursor cursor_in(std::string_view text);

bool is_name_letter(char c);

}  // namespace springlod::scripting
