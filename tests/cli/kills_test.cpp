#include <cstdlib>

#include <catch2/catch.hpp>
#include <sys/wait.h>

#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using namespace springlod::test;

TEST_CASE("A killed conversion is resumed or absent, and ends with the same bytes", "[long]") {
  const TemporaryFolder scratch;
  const std::string output = (scratch / "output.txt").string();
  const std::string script = (source_folder() / "tests/kills/kills.sh").string();
  const std::string program = (build_folder() / "app/springlod").string();
  const int status = std::system((script + " " + program + " " + (scratch / "kills").string() +
                                  " 4 1 convert-small > " + output + " 2>&1")
                                     .c_str());
  CAPTURE(slurp(output));
  CHECK(WEXITSTATUS(status) == 0);
  CHECK_THAT(slurp(output), Contains("convert-small       4"));
}
