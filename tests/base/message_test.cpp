#include "base/message.hpp"

#include <string>

#include <catch2/catch.hpp>

using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;
using springlod::counted;
using springlod::kLongestMessage;
using springlod::kLongestWord;
using springlod::printable;

TEST_CASE("A message without long words or control characters stays as it is") {
  for (const std::string text :
       {"", " ", "\n", "import: \"a b.obj\" does not exist;\n  check the path",
        "5 \u00b5m, \U0001F600"})
    CHECK(printable(text) == text);
}

TEST_CASE("Control characters and invalid UTF-8 are escaped") {
  CHECK(printable("a\033[31mred\a") == "a\\x1b[31mred\\x07");
  CHECK(printable(std::string("a\0b\r", 4)) == "a\\x00b\\x0d");
  CHECK(printable("\xff\xfe") == "\\xff\\xfe");
  CHECK(printable("cut \xe2\x82") == "cut \\xe2\\x82");
  CHECK(printable("\xc2\x9b"
                  "31m") == "\\xc2\\x9b31m");    // ESC [ in one character
  CHECK(printable("\xc0\xaf") == "\\xc0\\xaf");  // an overlong "/"
}

TEST_CASE("Of long words and messages the middle is left out") {
  const std::string word(100'000, 'x');
  const std::string message = printable("import: \"" + word + "\" does not exist; check the path");
  CHECK(message.size() < kLongestWord + 100);
  CHECK_THAT(message,
             StartsWith("import: \"xxx") && EndsWith("xxx\" does not exist; check the path"));

  std::string words;
  for (int i = 0; i < 50'000; ++i) words += "a ";
  const std::string all = printable("Bad material: " + words + "is unknown");
  CHECK(all.size() <= kLongestMessage);
  CHECK_THAT(all, StartsWith("Bad material: a") && EndsWith("a is unknown"));
}

TEST_CASE("A cut keeps characters whole") {
  for (std::size_t shift = 0; shift < 3; ++shift) {
    std::string word(shift, 'x');
    for (int i = 0; i < 1000; ++i) word += "\u20ac";  // three bytes each
    const std::string cut = printable(word);
    CHECK(cut.size() <= kLongestWord);
    CHECK(cut == printable(cut));  // no half character that would be escaped
  }
}

TEST_CASE("Counts of one are singular") {
  CHECK(counted(0, "run") == "0 runs");
  CHECK(counted(1, "run") == "1 run");
  CHECK(counted(3, "more cell") == "3 more cells");
}
