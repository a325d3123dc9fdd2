#pragma once

#include <cstddef>
#include <string>

namespace springlod::scripting {

/// Size of the terminal at stdout in characters; 0 if there is none or its size is unknown.
struct ScreenSize {
  std::size_t columns = 0;
  std::size_t rows = 0;
};
ScreenSize screen_size();

/// Prints `text` and a line end to stdout. If stdin and stdout are a terminal with fewer rows than
/// the text has lines, it is shown by the pager: $PAGER, or else `less` if it is installed.
void show_text(const std::string& text);

}  // namespace springlod::scripting
