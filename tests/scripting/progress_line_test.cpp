// Progress that fits the terminal.

#include <catch2/catch.hpp>

#include "scripting/engine/console.hpp"

using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using springlod::scripting::fitted_progress_line;

namespace {

std::string line(std::size_t columns, const char* detail = "step 12, residual 0.034") {
  return fitted_progress_line("factorizing the stiffness", 3000, 10000, 2, detail, columns);
}

}  // namespace

TEST_CASE("A line of progress that fits has a bar and its detail") {
  CHECK_THAT(line(200), Contains("[=======                 ]") && Contains(" 30 %") &&
                            Contains("left") && EndsWith("residual 0.034"));
}

TEST_CASE("A line of progress never exceeds the terminal, and drops its bar first") {
  CHECK_THAT(line(90), !Contains("[") && Contains(" 30 %") && EndsWith("residual 0.034"));
  for (std::size_t columns = 1; columns < 130; ++columns) CHECK(line(columns).size() <= columns);
  CHECK(line(9) == "factorizi");
  CHECK(line(38) == "factorizing the stiffness   30 %");  // not half a rate
}

TEST_CASE("Columns of a line of progress are characters, not bytes") {
  const std::string text = line(70,
                                "r\u00e9sidu \u00e9\u00e9\u00e9\u00e9\u00e9\u00e9\u00e9\u00e9\u00e9"
                                "\u00e9\u00e9\u00e9\u00e9\u00e9\u00e9\u00e9\u00e9\u00e9\u00e9");
  std::size_t characters = 0;
  for (const char c : text) characters += (static_cast<unsigned char>(c) & 0xC0U) != 0x80 ? 1 : 0;
  CHECK(characters <= 70);
  CHECK_THAT(text, EndsWith("\u00e9"));
}
