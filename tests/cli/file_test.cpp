// Files as scripts write and compare them.

#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::test::Ran;
using springlod::test::slurp;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace {

Ran run_lua(const TemporaryFolder& scratch, const std::string& code) {
  return springlod_run({"-q", "-e",
                        "local s = require 'springlod'\n"
                        "local folder = '" +
                            (scratch / "").string() + "'\n" + code});
}

}  // namespace

TEST_CASE("text is saved byte for byte, in folders that need not be there") {
  const TemporaryFolder scratch;
  const Ran ran = run_lua(scratch, R"(
    s.save_text(folder .. "new/deep/text", "old")
    s.save_text(folder .. "new/deep/text", "a\0b\r\n")
    print(#s.files(folder .. "new/deep"))
    print(pcall(s.save_text, folder .. "new/deep/text/below", "x")))");
  CAPTURE(ran.err);
  CHECK(slurp(scratch / "new" / "deep" / "text") == std::string("a\0b\r\n", 5));
  CHECK_THAT(ran.out, Contains("1\n") && Contains("cannot make the folder"));
}

TEST_CASE("the hash of a file is that of its text, and depends on every byte") {
  const TemporaryFolder scratch;
  const Ran ran = run_lua(scratch, R"(
    s.save_text(folder .. "file", "a\0b")
    print(s.hash{file = folder .. "file"} == s.hash{text = "a\0b"},
          s.hash{text = "a\0b"} ~= s.hash{text = "a\0c"}, s.hash{text = ""})
    print(pcall(s.hash, {file = folder .. "none"}))
    print(pcall(s.hash, {}))
    print(pcall(s.hash, {file = "x", text = "y"})))");
  CAPTURE(ran.err);
  CHECK_THAT(ran.out, Contains("true\ttrue\t2d06800538d394c2\n") && Contains("cannot read"));
  CHECK_THAT(ran.out, Contains("give either file or text"));
}
