#include <algorithm>
#include <csignal>
#include <sstream>

#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::test::Ran;
using springlod::test::slurp;
using springlod::test::spit;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;
using springlod::test::Terminal;
using springlod::test::TerminalSetup;

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
  terminal.type("s.mesh('ball.obj')\n");
  CHECK(terminal.shows("springlod has no 'mesh'; a Mesh comes from s.import;"));
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
  terminal.type("10 * #m.nodes\t()\n");
  CHECK(terminal.shows("\n10"));
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

TEST_CASE("exit and quit, alone on a line, leave the prompt") {
  const TemporaryFolder scratch;
  for (const char* word : {"exit\n", "quit\n", " exit() ;\n", "quit()\n"}) {
    Terminal terminal({}, scratch.path());
    REQUIRE(terminal.shows("> "));
    terminal.type(word);
    CHECK(terminal.exit_code() == 0);
  }
  // Not a name that the session has defined.
  const Ran ran = springlod_run({"-i"}, "quit = 'mine'\nquit\nexit\n'not reached'\n");
  CHECK(ran.exit_code == 0);
  CHECK(ran.out == "mine\n");
}

TEST_CASE("the history is kept whatever ends the prompt") {
  const auto end = GENERATE(as<std::string>(), "exit", "os.exit(3)", "os.exit(3, true)", "term",
                            "term while busy", "hang up", "kill");
  INFO(end);
  const TemporaryFolder scratch;
  const TerminalSetup utf8{.environment = {{"TERM", "dumb"}, {"LC_ALL", "C.UTF-8"}}};
  {
    Terminal terminal({}, scratch.path(), utf8);
    REQUIRE(terminal.shows("> "));
    terminal.type("print('first \\\\ ' ..\n");
    REQUIRE(terminal.shows(">> "));
    terminal.type("'\xC3\xBC line')\n");
    REQUIRE(terminal.shows("\nfirst \\ \xC3\xBC line"));
    REQUIRE(terminal.shows("> "));
    int exit_code = 0;
    if (end == "term while busy") {
      terminal.type("print('busy') while true do end\n");
      REQUIRE(terminal.shows("\nbusy"));
    }
    if (end.starts_with("term")) {
      terminal.signal(SIGTERM);
      exit_code = 128 + SIGTERM;
    } else if (end == "hang up") {
      terminal.signal(SIGHUP);
      exit_code = 128 + SIGHUP;
    } else if (end == "kill") {
      terminal.signal(SIGKILL);
      exit_code = 128 + SIGKILL;
    } else {
      terminal.type(end + "\n");
      exit_code = end == "exit" ? 0 : 3;
    }
    CHECK(terminal.exit_code() == exit_code);
  }
  Terminal terminal({}, scratch.path(), utf8);
  REQUIRE(terminal.shows("> "));
  // What ended the session may be the last entry.
  terminal.type(end.starts_with("os.") || end == "term while busy" ? "\x10\x10\n" : "\x10\n");
  CHECK(terminal.shows("\nfirst \\ \xC3\xBC line"));
}

TEST_CASE("the history file is bounded, and a damaged one is moved aside") {
  const TemporaryFolder scratch;
  const auto file = scratch / "springlod/history";
  std::string text = "_HiStOrY_V2_\n";
  for (int i = 0; i < 5000; ++i) text += "entry\\040" + std::to_string(i) + "\n";
  spit(file, text + "torn off");
  const auto session = [&] {
    Terminal terminal({}, scratch.path());
    REQUIRE(terminal.shows("> "));
    terminal.type("'new' .. 'est'\n");
    REQUIRE(terminal.shows("\nnewest"));
    REQUIRE(terminal.shows("> "));
    terminal.type("exit\n");
    REQUIRE(terminal.exit_code() == 0);
  };
  session();
  const std::string shorter = slurp(file);
  CHECK(std::count(shorter.begin(), shorter.end(), '\n') <= 2002);
  CHECK_THAT(shorter, Contains("0404999\n") && !Contains("040100\n"));
  CHECK(shorter.ends_with("'new'\\040..\\040'est'\n"));

  spit(file, "nothing of ours");
  session();
  CHECK(slurp(file) == "_HiStOrY_V2_\n'new'\\040..\\040'est'\n");
  CHECK(slurp(scratch / "springlod/history.damaged") == "nothing of ours");
}

TEST_CASE("Tab completes files in strings, and option keys and words in calls") {
  const TemporaryFolder scratch;
  spit(scratch / "meshes/dumb.obj", "");
  spit(scratch / "meshes/.hidden", "");
  Terminal terminal({}, scratch.path(), {.folder = scratch.path()});
  REQUIRE(terminal.shows("> "));
  terminal.type("print('mes\td\t .. '!')\n");
  CHECK(terminal.shows("\nmeshes/dumb.obj!"));
  REQUIRE(terminal.shows("> "));
  terminal.type("s.scenario{dura\t2,\n");
  REQUIRE(terminal.shows(">> "));
  terminal.type("gravity = {0, 0, 0}, obstacles = {{pla\t{0, 0, 1, 0}}}}\n");
  CHECK(terminal.shows("2 s, 1 obstacle"));
  REQUIRE(terminal.shows("> "));
  terminal.type("s.simplify(nil, {border = \t\t");
  CHECK(terminal.shows("none  strong  weak"));
}

TEST_CASE("help fits the width of the terminal and pages if it is longer than the screen") {
  const TemporaryFolder scratch;
  const auto widest = [](const std::string& screen) {
    std::size_t width = 0;
    std::istringstream lines(screen);
    for (std::string line; std::getline(lines, line);) {
      while (!line.empty() && line.back() == '\r') line.pop_back();
      width = std::max(width, line.size());
    }
    return width;
  };
  {
    Terminal terminal({"-e", "help()"}, scratch.path(), {.columns = 60});
    CHECK(terminal.exit_code() == 0);
    CHECK(widest(terminal.screen()) <= 60);
    CHECK_THAT(terminal.screen(), Contains("Values"));
  }
  const auto paged = [&](unsigned short rows, const std::string& pager, const std::string& type) {
    Terminal terminal(
        {"-e", "help() print('after')"}, scratch.path(),
        {.columns = 80, .rows = rows, .environment = {{"TERM", type}, {"PAGER", pager}}});
    CHECK(terminal.exit_code() == 0);
    CHECK_THAT(terminal.screen(), Contains("after"));
    return terminal.screen();
  };
  CHECK_THAT(paged(24, "sed s/^/paged:/", "vt100"), Contains("paged:  simplify"));
  CHECK_THAT(paged(1000, "sed s/^/paged:/", "vt100"), !Contains("paged:"));
  CHECK_THAT(paged(24, "sed s/^/paged:/", "dumb"), !Contains("paged:"));
  // A pager that is left early, and one that does not exist.
  CHECK_THAT(paged(24, "head -n 1", "vt100"), !Contains("simplify"));
  CHECK_THAT(paged(24, "/no/such/pager", "vt100"), Contains("simplify"));
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

TEST_CASE("help without brackets shows the help") {
  const auto typed = [](const std::string& lines) {
    const Ran ran = springlod_run({"-i"}, lines);
    CHECK(ran.exit_code == 0);
    return ran;
  };
  CHECK(typed("help\n").out == typed("help()\n").out);
  CHECK_THAT(typed("help\n").out, Contains("simplify"));
  const std::string text = typed("help('simplify')\n").out;
  CHECK_THAT(text, Contains("s.simplify("));
  for (const char* line : {"help simplify\n", " help  s.simplify \n", "help('s.simplify')\n"})
    CHECK(typed(line).out == text);
  CHECK_THAT(typed("help Mesh\n").out, Contains("vertex_count"));
  CHECK_THAT(typed("help info\n").out, Contains("s.info("));
  CHECK_THAT(typed("help convert\n").err, Contains("springlod help convert explains it"));
  CHECK_THAT(typed("help simplfy\n").err, Contains("did you mean 'simplify'?"));
  // Not a name that the session has defined.
  CHECK(typed("help = 5\nhelp\n").out == "5\n");
}

TEST_CASE("a command of the shell at the prompt is answered with what does the same in Lua") {
  const Ran ran = springlod_run({"-i"}, R"(springlod info x.glb
info mesh.obj --unit cm
  springlod compare a.glb --scenario drop.lua
export a.glb --to jolt
springlod run main.lua
springlod help info
springlod --help
springlod
demo
$ springlod demo -q
'still ' .. 'here'
)");
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK(ran.out == "still here\n");
  CHECK_THAT(ran.err,
             Contains("a command for the shell") && Contains("leave with exit") &&
                 Contains("type: springlod info x.glb\nhere, in Lua: s.load(\"x.glb\")\n") &&
                 Contains("type: springlod info mesh.obj --unit cm\nhere, in Lua: "
                          "s.import(\"mesh.obj\")\n") &&
                 Contains("here, in Lua: s.compare; ") && Contains("here, in Lua: s.export; "));
  CHECK_THAT(ran.err, Contains("dofile(\"main.lua\")\n") && Contains("help(\"info\")\n") &&
                          Contains("type: springlod --help\n") && Contains("type: springlod\n") &&
                          Contains("type: springlod demo\n") &&
                          Contains("type: springlod demo -q\n"));
  // Names that a session has defined, and Lua that begins with such a word.
  const Ran own = springlod_run({"-i"}, "info = 5\ninfo\ninfo - 2\nrun = print\nrun('x')\n");
  CHECK(own.out == "5\n3\nx\n");
  CHECK_THAT(own.err, !Contains("shell"));
}

TEST_CASE("help on a variable that does not exist says so") {
  const Ran ran = springlod_run({"-i"}, "help(mesh)\nhelp( blorbs )\n");
  CHECK(ran.out.empty());
  CHECK(ran.err ==
        "mesh is nil: there is no such variable; did you mean help(\"Mesh\")?\n"
        "blorbs is nil: there is no such variable; help() lists all functions and values\n");
  const Ran known = springlod_run({"-i"}, "x = s.simplify\nhelp(x)\nhelp(s.seed)\n");
  CHECK(known.err.empty());
  CHECK_THAT(known.out, Contains("s.simplify(") && Contains("s.seed: integer"));
}

TEST_CASE("a lost local variable is explained once") {
  const auto hints = [](const std::string& lines) {
    const Ran ran = springlod_run({"-i"}, lines);
    CAPTURE(lines, ran.err);
    CHECK(ran.exit_code == 0);
    return ran.err;
  };
  const std::string hint =
      "note: at the prompt a local variable lasts for its line only; leave out \"local\" to use ";
  CHECK(hints("local q = 1\nq\nlocal r = 2\n") == hint + "q in later lines\n");
  CHECK(hints("  local a <const>, b = 1, {2}; \n") == hint + "a, b in later lines\n");
  CHECK(hints("local a;\n") == hint + "a in later lines\n");
  CHECK(hints("local function f(x)\nreturn x\nend\n") == hint + "f in later lines\n");
  // Lines that do something with the variable, and the line that scripts begin with.
  CHECK(hints("local q = 1 print(q)\nlocal q = 1; print(q)\nlocal q q = 2\nlocal q print()\n"
              "localq = 1\nlocal function f() end f()\nlocal s = require 'springlod'\n")
            .empty());
}

TEST_CASE("a mistake at the prompt is one line") {
  const Ran ran = springlod_run({"-i"}, "s.simplify()\nlocal x = y.z\nerror('own', 0)\n");
  CHECK(std::count(ran.err.begin(), ran.err.end(), '\n') == 3);
  CHECK_THAT(ran.err, Contains("input:1: bad argument 1 (model) of simplify") &&
                          Contains("\ninput:1: attempt to index a nil value (global 'y')\nown\n"));
  CHECK_THAT(springlod_run({"-v", "-i"}, "s.simplify()\n").err, Contains("stack traceback:"));
}

TEST_CASE("a method or a function without its call says how to call it") {
  const Ran ran = springlod_run({"-i"},
                                "base = s.model{nodes = {{0, 0, 0, mass = 1}}}\n"
                                "base.nodes\nf = base.nodes\nf\ns.simplify\nprint\n");
  CHECK(ran.err.empty());
  CHECK_THAT(ran.out,
             Contains("a method: call base:nodes() -> list") &&
                 Contains("help(\"Model:nodes\") explains it\na method: call model:nodes()"));
  CHECK_THAT(ran.out, Contains("\na function: s.simplify(") &&
                          Contains("; help(s.simplify) explains it\nfunction: "));
}

TEST_CASE("a function of the API that is called without s is named with it") {
  const Ran ran = springlod_run({"-i"}, "load_mesh('x.obj')\nvoxelize(mesh)\n");
  CHECK_THAT(ran.err, Contains("did you mean s.voxelize?") && !Contains("s.load_mesh"));
}
