#include "base/message.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace springlod::inline base {
namespace {

bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

// Length of the UTF-8 character at the start of `text`; 0 if there is no valid one. Surrogates and
// overlong forms pass: terminals replace them.
std::size_t character_size(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t size = first < 0x80   ? 1
                           : first < 0xC2 ? 0
                           : first < 0xE0 ? 2
                           : first < 0xF0 ? 3
                           : first < 0xF5 ? 4
                                          : 0;
  if (size > text.size()) return 0;
  const bool whole = std::all_of(
      text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(size, 1)),
      continues_character);
  return whole ? size : 0;
}

bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character.front());
  // U+0080 to U+009F, of which U+009B begins an escape sequence as ESC [ does.
  if (character.size() == 2 && first == 0xC2)
    return static_cast<unsigned char>(character[1]) < 0xA0;
  return (first < 0x20 && first != '\n') || first == 0x7F;
}

std::string escaped(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t size = character_size(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(size, 1));
    if (size == 0 || is_control(character)) {
      for (const char c : character)
        result += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    } else {
      result += character;
    }
    text.remove_prefix(character.size());
  }
  return result;
}

// The start and the end of `text` with "..." between them, `most` bytes; whole characters only.
std::string without_middle(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  constexpr std::string_view kGap = "...";
  std::size_t head = (most - kGap.size()) / 2;
  std::size_t tail = text.size() - (most - kGap.size() - head);
  while (head > 0 && continues_character(text[head])) --head;
  while (tail < text.size() && continues_character(text[tail])) ++tail;
  return fmt::format("{}{}{}", text.substr(0, head), kGap, text.substr(tail));
}

}  // namespace

std::string printable(std::string_view message) {
  // Text that will be cut is not escaped: it may have millions of characters.
  const std::string escaped_text = escaped(without_middle(message, 8 * kLongestMessage));
  std::string result;
  for (std::size_t start = 0; start < escaped_text.size();) {
    const std::size_t end =
        std::min(escaped_text.find_first_of(" \n", start), escaped_text.size() - 1) + 1;
    result +=
        without_middle(std::string_view(escaped_text).substr(start, end - start), kLongestWord);
    start = end;
  }
  return without_middle(result, kLongestMessage);
}

std::string counted(std::uint64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace springlod::inline base
