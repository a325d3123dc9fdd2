// What does not fit into the memory is refused before it is begun.

#include <string>

#include <catch2/catch.hpp>

#include "tests/support/program.hpp"
#include "tests/support/sanitized.hpp"

using Catch::Matchers::Contains;
using springlod::test::slurp;
using springlod::test::spit;
using springlod::test::TemporaryFolder;

TEST_CASE("Lattices, modes and fits that need more memory than there is are refused") {
  if (springlod::test::kSanitized) return;
  const TemporaryFolder scratch;
  spit(scratch / "memory.lua", R"(
    local s = require "springlod"
    local function cube(n)
      return s.grid{cell = 1 / n, size = {n, n, n}, materials = {soft = {}},
                    fill = function() return "soft" end}
    end
    local function refusal(f, ...) return tostring(select(2, pcall(f, ...))) end
    print(refusal(s.lattice, cube(110)))
    print(refusal(s.modes, s.lattice(cube(20)), {count = 1e6}))
    print(refusal(s.simplify, s.lattice(cube(32)), {calibrate = "modes"}))
    print(s.modes(s.lattice(cube(10)), {count = 1})[1].frequency > 0)
  )");
  const std::string printed = (scratch / "printed.txt").string();
  const std::string program = (springlod::test::build_folder() / "app/springlod").string();
  // Blocks of 1024 bytes.
  const int status = std::system(("ulimit -v 1000000; " + program + " -q run " +
                                  (scratch / "memory.lua").string() + " > " + printed + " 2>&1")
                                     .c_str());
  const std::string text = slurp(printed);
  CAPTURE(text);
  CHECK(WEXITSTATUS(status) == 0);
  CHECK_THAT(text, Contains("lattice: 1.33e+06 cells of 0.009091 m need 1.2 GB of memory, and 0."));
  CHECK_THAT(text, Contains("; use a cell of 0.01"));
  CHECK_THAT(text, Contains("modes: 27777 modes of 9261 nodes need 24.7 GB of memory"));
  CHECK_THAT(text, Contains("calibration: a body of 35937 nodes needs at least 1.08 GB of memory"));
  CHECK_THAT(text, Contains("true"));
}
