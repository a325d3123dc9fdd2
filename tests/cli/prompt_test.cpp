#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::test::Ran;
using springlod::test::slurp;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;
using springlod::test::Terminal;

TEST_CASE("the prompt prints the value of an expression and exits on Ctrl-D") {
  const TemporaryFolder scratch;
  Terminal terminal({}, scratch.path());
  REQUIRE(terminal.shows("> "));
  terminal.type("6 * 7\n");
  CHECK(terminal.shows("\n42"));
  terminal.type("x = {b = 2, a = {1, 'two'}}\n");
  terminal.type("x\n");
  CHECK(terminal.shows("{a = {1, \"two\"}, b = 2}"));
  terminal.type("s.scenario{duration = 2}\n");
  CHECK(terminal.shows("Scenario scenario: 2 s, 0 obstacles"));
  // Between two prompts the terminal is in line mode and would take Ctrl-D for itself.
  REQUIRE(terminal.shows("> "));
  terminal.type("\x04");
  CHECK(terminal.exit_code() == 0);
}

TEST_CASE("the prompt accepts a chunk of several lines") {
  const TemporaryFolder scratch;
  Terminal terminal({}, scratch.path());
  REQUIRE(terminal.shows("> "));
  terminal.type("for i = 1, 2 do\n");
  REQUIRE(terminal.shows(">> "));
  terminal.type("print('line', i)\n");
  REQUIRE(terminal.shows(">> "));
  terminal.type("end\n");
  CHECK(terminal.shows("line\t1"));
  CHECK(terminal.shows("line\t2"));
}

TEST_CASE("the prompt continues after an error") {
  const TemporaryFolder scratch;
  Terminal terminal({}, scratch.path());
  REQUIRE(terminal.shows("> "));
  terminal.type("s.simplfy()\n");
  CHECK(terminal.shows("springlod has no 'simplfy'; did you mean 'simplify'?"));
  terminal.type("help('simplfy')\n");
  CHECK(terminal.shows("did you mean 'simplify'?"));
  terminal.type("'still ' .. 'here'\n");
  CHECK(terminal.shows("still here"));
}

TEST_CASE("Ctrl-C at the prompt abandons the line, or the chunk, or the computation") {
  const TemporaryFolder scratch;
  Terminal terminal({}, scratch.path());
  REQUIRE(terminal.shows("> "));
  terminal.type("broken = 'never");
  REQUIRE(terminal.shows("never"));
  terminal.type("\x03");
  REQUIRE(terminal.shows("> "));
  terminal.type("broken == nil\n");
  CHECK(terminal.shows("\ntrue"));

  terminal.type("function f(\n");
  REQUIRE(terminal.shows(">> "));
  terminal.type("\x03");
  REQUIRE(terminal.shows("> "));

  terminal.type("print('busy') while true do end\n");
  REQUIRE(terminal.shows("\nbusy"));
  terminal.type("\x03");
  CHECK(terminal.shows("interrupted"));
  terminal.type("1 + 1\n");
  CHECK(terminal.shows("\n2"));
}

TEST_CASE("Tab completes names of the API, of values and of globals") {
  const TemporaryFolder scratch;
  Terminal terminal({}, scratch.path());
  REQUIRE(terminal.shows("> "));
  terminal.type("s.simpl\t(1)\n");
  CHECK(terminal.shows("bad argument 1 (model) of simplify"));
  terminal.type("m = s.model{nodes = {{0, 0, 0, mass = 1}}}\n");
  REQUIRE(terminal.shows("> "));
  terminal.type("m.node_c\t\n");
  CHECK(terminal.shows("\n1"));
  terminal.type("s.st\t\t");
  CHECK(terminal.shows("stable_step  static_loads  statistics  stretch"));
}

TEST_CASE("the prompt remembers its lines for the next session") {
  const TemporaryFolder scratch;
  {
    Terminal terminal({}, scratch.path());
    REQUIRE(terminal.shows("> "));
    terminal.type("'first ' .. 'session'\n");
    REQUIRE(terminal.shows("\nfirst session"));
    REQUIRE(terminal.shows("> "));
    terminal.type("\x04");
    REQUIRE(terminal.exit_code() == 0);
  }
  CHECK_THAT(slurp(scratch / "springlod/history"), Contains("session"));
  Terminal terminal({}, scratch.path());
  REQUIRE(terminal.shows("> "));
  terminal.type("\x10\n");  // Ctrl-P: previous line
  CHECK(terminal.shows("\nfirst session"));
}

TEST_CASE("the flag -i opens a prompt after the code, with its globals") {
  const TemporaryFolder scratch;
  Terminal terminal({"-i", "-e", "answer = 42"}, scratch.path());
  REQUIRE(terminal.shows("> "));
  terminal.type("answer\n");
  CHECK(terminal.shows("\n42"));
}

TEST_CASE("the flag -i without a terminal reads lines from stdin") {
  const Ran ran = springlod_run({"-i"}, "x = 20\nx + 1\nfor i = 1, 1 do\nprint('in')\nend\n");
  CHECK(ran.exit_code == 0);
  CHECK(ran.out == "21\nin\n");
}
