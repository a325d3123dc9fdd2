#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace springlod::inline base {

/// A message that contains text of a user, fit for a terminal and a log: control characters other
/// than line ends and invalid UTF-8 as "\x1b", words of more than kLongestWord bytes (such as
/// paths) and messages of more than kLongestMessage bytes with "..." in place of their middle. The
/// middle, because a message begins with what is wrong and ends with what to do.
std::string printable(std::string_view message);

/// "1 run", "3 runs".
std::string counted(std::uint64_t count, std::string_view noun);

inline constexpr std::size_t kLongestWord = 300;      ///< [bytes]
inline constexpr std::size_t kLongestMessage = 2000;  ///< [bytes]

}  // namespace springlod::inline base
