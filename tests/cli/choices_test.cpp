// The words that options may take, in scripts, help and commands.

#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::test::Ran;
using springlod::test::springlod_run;

TEST_CASE("s.choices lists the words of options and explains each") {
  const Ran ran = springlod_run({"-e", R"(
    local s = require "springlod"
    print(table.concat(s.choices.border, " "))
    print(s.choices.border.weak.help)
    assert(s.choices.grouping.metis.from_base and not s.choices.grouping.metis.follows_border)
    assert(s.choices.integrator.xpbd.implicit and not s.choices.integrator.xpbd.fast)
    assert(#s.choices.unit == 9 and s.choices.unit.ft)
    for name, words in pairs(s.choices) do
      for _, word in ipairs(words) do assert(type(words[word].help) == "string", name) end
    end)"});
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("none weak strong") && Contains("only with border nodes"));
}

TEST_CASE("help explains the words of an option, by option and by name") {
  CHECK_THAT(springlod_run({"-e", "help('border')"}).out,
             Contains("s.choices.border") && Contains("\"strong\": border nodes never merge"));
  CHECK_THAT(springlod_run({"-e", "help(require('springlod').simplify)"}).out,
             Contains("\"compact\": round groups"));
}

TEST_CASE("a wrong word is refused with the right ones") {
  const Ran ran = springlod_run({"-e",
                                 "local s = require 'springlod'\n"
                                 "s.simplify(s.model{nodes = {{0, 0, 0, mass = 1}}}, "
                                 "{border = 'week'})"});
  CHECK(ran.exit_code == 1);
  CHECK_THAT(ran.err, Contains("one of none, weak, strong") && Contains("did you mean 'weak'?"));
}
