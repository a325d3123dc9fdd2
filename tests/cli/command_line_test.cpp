#include <algorithm>

#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using springlod::test::Ran;
using springlod::test::spit;
using springlod::test::springlod_interrupted;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

TEST_CASE("the options --version and --help go to stdout and exit 0") {
  const Ran version = springlod_run({"--version"});
  CHECK(version.exit_code == 0);
  CHECK_THAT(version.out, StartsWith("springlod "));
  CHECK(version.err.empty());

  const Ran help = springlod_run({"--help"});
  CHECK(help.exit_code == 0);
  for (const char* command : {"\n  run ", "\n  convert ", "\n  info ", "\n  compare "})
    CHECK_THAT(help.out, Contains(command));
  CHECK_THAT(help.out, Contains("Convert meshes to LOD assets."));
}

TEST_CASE("wrong use exits 2 with a reason and similar names on stderr") {
  const auto wrong = [](const std::vector<std::string>& arguments, const std::string& reason) {
    const Ran ran = springlod_run(arguments);
    CAPTURE(ran.out, ran.err);
    CHECK(ran.exit_code == 2);
    CHECK(ran.out.empty());
    CHECK_THAT(ran.err, Contains(reason));
    CHECK(std::count(ran.err.begin(), ran.err.end(), '\n') == 2);  // the reason, and one for usage
  };
  wrong({"conver", "x.obj"}, "did you mean 'convert'?");
  for (const char* near : {"covnert", "convrt", "convretr", "conver", "conv"})
    wrong({near, "x.obj"}, "did you mean 'convert'?");
  wrong({"rnedr", "x.obj"}, "did you mean 'render'?");
  wrong({"simulate", "x.glb"}, "did you mean 'compare'?");
  wrong({"samples/dumbbell.obj"},
        "for a mesh or an asset: springlod info samples/dumbbell.obj, or "
        "springlod render samples/dumbbell.obj\n");
  wrong({"none.glb"}, "springlod info none.glb, or springlod render none.glb\n");
  wrong({"frobnicate"}, "commands are: run, compare, convert");
  wrong({"thing.lua"}, "springlod run thing.lua");
  wrong({"--sede", "3"}, "did you mean '--seed'?");
  wrong({"--seed", "many", "-e", "x = 1"}, "springlod: --seed: 'many' must be an integer of 0 to");
  wrong({"--seed", "-1", "-e", "x = 1"}, "--seed: '-1' must be an integer of 0 to");
  wrong({"--threads", "x"}, "springlod: --threads: 'x' must be an integer of 0 to 4294967295\n");
  wrong({"info", "a.glb", "--threads", "1.5"}, "--threads: '1.5' must be an integer");
  wrong({"--memory-limit", "4 cats"}, "--memory-limit: '4 cats' must be a number of bytes");
  wrong({"--threads"}, "springlod: --threads needs a value: --threads N\n");
  wrong({"info", "a.glb", "--seed"}, "springlod: --seed needs a value: --seed N\n");
  wrong({"--time-limit"}, "springlod: --time-limit needs a value: --time-limit T\n");
  wrong({"-e"}, "springlod: -e needs a value: -e CODE\n");
  wrong({"--seed", "1", "--seed", "2", "-e", "x = 1"}, "springlod: give --seed once\n");
  for (const char* flag :
       {"-q", "--quiet", "-v", "--unsafe", "--portable", "-i", "--version", "-h"})
    wrong({flag + std::string("=3"), "-e", "x = 1"}, flag + std::string(" takes no value\n"));
  wrong({"--seed", "1", "-q=3", "-e", "x = 1"}, "springlod: -q takes no value\n");
  wrong({"info", "a.glb", "-q=3"}, "springlod: -q takes no value\n");
  wrong({"run"}, "run needs a script");
  wrong({"info"}, "missing argument 'file'");
  wrong({"poisson_ways", "--csv", "a.csv"}, "--csv is now --out");
  wrong({"figures", "a", "--out", "b"}, "give the folder once");
  wrong({"render", "a.glb", "-o", "a.jpg"}, "must end in .png");
  wrong({"convert", "a.obj", "-o", "a.glb", "--leves", "2"}, "unknown option '--leves'");
  wrong({"convert", "a.obj", "-o", "a.glb", "--grouping", "stndard"}, "'priority_hard'");
  wrong({"convert", "a.obj", "-o", "a.glb", "--cell", "2kg"}, "--cell: \"2kg\"");
  wrong({"convert", "a.obj", "-o", "a.glb", "--levels", "-1"}, "--levels");
  wrong({"convert", "a.obj", "-o", "a.txt"}, "must end in .glb");
  wrong({"convert", "a.obj", "-o", "a.glb", "--fast", "--resume", "x"}, "--calibrate modes");
  wrong({"compare", "a.glb", "--out", "x"}, "--scenario");
  wrong({"mergelog"}, "missing argument 'asset'");
  wrong({"mergelog", "a.glb", "--least", "1"}, "--least must be below 1");
  wrong({"mergelog", "a.glb", "--leave-out", "1"}, "--leave-out must be below 1");
}

TEST_CASE("every command has help") {
  for (const char* command :
       {"convert", "info", "compare", "demo", "export", "help", "materials", "mergelog", "new",
        "pareto", "pick", "picks", "render", "slim", "stability", "refinement"}) {
    const Ran ran = springlod_run({command, "--help"});
    CAPTURE(command);
    CHECK(ran.exit_code == 0);
    CHECK_THAT(ran.out, StartsWith("Usage: springlod " + std::string(command)));
    CHECK_THAT(ran.out, Contains("--seed"));
  }
}

TEST_CASE("run --help explains run") {
  for (const char* flag : {"--help", "-h"}) {
    const Ran ran = springlod_run({"run", flag});
    CHECK(ran.exit_code == 0);
    CHECK_THAT(ran.out, StartsWith("usage: springlod [FLAGS] run SCRIPT.lua"));
  }
}

TEST_CASE("help explains commands, functions, values, pages and sections of pages") {
  const auto help = [](const std::vector<std::string>& words) {
    std::vector<std::string> arguments{"help"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    return springlod_run(arguments);
  };
  const Ran all = help({});
  CHECK(all.exit_code == 0);
  CHECK_THAT(all.out, Contains("\n  convert ") && Contains("\n  refinement ") &&
                          Contains(" simplify ") && Contains("\n  simulate "));
  CHECK_THAT(help({"convert"}).out, StartsWith("Usage: springlod convert") &&
                                        Contains("--hinges") &&
                                        Contains("See also:\n  docs/convert.md"));
  CHECK(help({"run"}).exit_code == 0);
  CHECK_THAT(help({"voxelize"}).out, StartsWith("s.voxelize(mesh"));
  CHECK_THAT(help({"material"}).out, StartsWith("Material\n"));
  CHECK_THAT(help({"scenes"}).out, StartsWith("Scenario\n"));
  CHECK_THAT(help({"simulate"}).out, StartsWith("# Simulate a scenario"));
  CHECK_THAT(help({"energy", "ledger"}).out, Contains("docs/simulate.md, The energy ledger"));
  CHECK_THAT(help({"holes"}).out, StartsWith("(docs/convert.md, Faults and holes of the mesh)"));
  CHECK_THAT(help({"blender"}).out, StartsWith("(docs/export.md, Motion in Blender)"));
  // Of other words, pages that have them all, with a line of each.
  CHECK_THAT(help({"watertight"}).out, Contains("docs/convert.md (1 line)  A mesh need not"));
  CHECK_THAT(help({"poisson", "ratio"}).out, Contains("docs/models.md"));
  const Ran none = help({"blorb"});
  CHECK(none.exit_code == 1);
  CHECK_THAT(none.err, Contains("no help on 'blorb'") && Contains("lists all topics"));
}

TEST_CASE("the help of commands names options by their flags") {
  const std::string text = springlod_run({"convert", "--help"}).out;
  CHECK_THAT(text, !Contains("= \"") && Contains("-o, --out <asset>"));
}

TEST_CASE("materials lists the presets, which materials take unless they say otherwise") {
  const Ran table = springlod_run({"materials"});
  CHECK(table.exit_code == 0);
  CHECK_THAT(table.out, Contains("natural_rubber") && Contains("1.9 MPa"));
  CHECK_THAT(table.out, Contains("Dowling"));
  const Ran same = springlod_run({"-q", "-e", R"(
    local s = require "springlod"
    local function material(given)
      return s.grid{cell = 1, size = {1, 1, 1}, materials = {a = given},
                    fill = function() return "a" end}.materials[1]
    end
    assert(#s.material_presets == 20)
    for _, preset in ipairs(s.material_presets) do
      local found = material{preset = preset.name}
      assert(found.young == preset.young and found.poisson == preset.poisson)
      assert(found.density == preset.density and #preset.source > 10)
    end
    local own = material{preset = "cork", density = 200}
    assert(own.density == 200 and own.poisson == 0)
    local ok, failure = pcall(material, {preset = "crok"})
    assert(not ok and failure.message:find("did you mean 'cork'", 1, true), failure.message))"});
  CAPTURE(same.err);
  CHECK(same.exit_code == 0);
}

TEST_CASE("code comes from -e, a script, or a pipe") {
  CHECK(springlod_run({"-e", "print(1 + 1)"}).out == "2\n");
  CHECK(springlod_run({"-e", "print(...)", "a", "b"}).out == "a\tb\n");
  CHECK(springlod_run({}, "print('piped')").out == "piped\n");

  const TemporaryFolder scratch;
  spit(scratch / "helper.lua", "return {word = 'from beside'}");
  spit(scratch / "main.lua", "print(require('helper').word, arg[0] ~= nil, #arg, ...)");
  const std::string script = (scratch / "main.lua").string();
  CHECK(springlod_run({"run", script}).out == "from beside\ttrue\t0\n");
  CHECK(springlod_run({"run", script, "--", "-x", "--seed", "y"}).out ==
        "from beside\ttrue\t3\t-x\t--seed\ty\n");
}

TEST_CASE("global flags stand before the command or after it") {
  const std::string code =
      "s = require 'springlod' print(s.seed, s.threads, s.verbosity, s.portable)";
  CHECK(springlod_run({"-e", code}).out == "1\t0\t0\tfalse\n");
  CHECK(springlod_run({"--seed", "7", "--threads", "2", "-v", "-e", code}).out ==
        "7\t2\t1\tfalse\n");
  CHECK(springlod_run({"-q", "--portable", "-e", code}).out == "1\t0\t-1\ttrue\n");

  const TemporaryFolder scratch;
  spit(scratch / "seed.lua", code);
  const std::string script = (scratch / "seed.lua").string();
  CHECK(springlod_run({"run", script, "--seed", "9", "-q"}).out == "9\t0\t-1\tfalse\n");
  CHECK(springlod_run({"run", script, "--portable"}).out == "1\t0\t0\ttrue\n");
  CHECK(springlod_run({"--seed", "8", "run", script}).out == "8\t0\t0\tfalse\n");
}

TEST_CASE("a failing script exits 1 with its line, and with a traceback under -v") {
  const TemporaryFolder scratch;
  spit(scratch / "bad.lua",
       "local s = require 'springlod'\n"
       "local function build()\n"
       "  return s.simplify(s.model{nodes = {{0, 0, 0, mass = 1}}}, {level = 2})\n"
       "end\n"
       "build()\n");
  const std::string script = (scratch / "bad.lua").string();
  for (const bool verbose : {false, true}) {
    const Ran ran = verbose ? springlod_run({"-v", "run", script}) : springlod_run({"run", script});
    CAPTURE(verbose, ran.err);
    CHECK(ran.exit_code == 1);
    CHECK(ran.out.empty());
    CHECK_THAT(ran.err,
               Contains("bad.lua:3: unknown option 'level'; did you mean 'levels'? simplify "
                        "takes: levels, keep, grouping, border, seed, grading, straight"));
    for (const char* part : {"stack traceback:", "bad.lua:5: in main chunk"})
      CHECK((ran.err.find(part) != std::string::npos) == verbose);
  }
  // An error value that is no text has no line of its own.
  CHECK_THAT(springlod_run({"-e", "\nerror{}"}).err, StartsWith("springlod: -e:2: table: "));
  CHECK(springlod_run({"-e", "\nerror('broken')"}).err == "springlod: -e:2: broken\n");

  CHECK(springlod_run({"-e", "x = = 1"}).exit_code == 1);
  CHECK(springlod_run({"-e", "error{}"}).exit_code == 1);
  CHECK(springlod_run({"-e", "os.exit(7)"}).exit_code == 7);
  const Ran missing = springlod_run({"run", (scratch / "none.lua").string()});
  CHECK(missing.exit_code == 1);
  CHECK_THAT(missing.err, Contains("none.lua"));
}

TEST_CASE("Ctrl-C stops a Lua loop that catches every error") {
  const Ran ran = springlod_interrupted(
      {"-e", "io.stderr:write('going\\n') while true do pcall(function() end) end"}, "going\n");
  CHECK(ran.exit_code == 130);
  CHECK_THAT(ran.err, Contains("interrupted"));
}

TEST_CASE("SIGTERM stops a script as Ctrl-C does") {
  const Ran ran = springlod_interrupted(
      {"-e", "io.stderr:write('going\\n') while true do pcall(function() end) end"}, "going\n",
      SIGTERM);
  CHECK(ran.exit_code == 143);
  CHECK_THAT(ran.err, Contains("springlod: terminated"));
}

TEST_CASE("Ctrl-C stops a long simulation") {
  const Ran ran = springlod_interrupted(
      {"-e",
       "local s = require 'springlod'\n"
       "local m = s.model{nodes = {{0, 0, 0, mass = 1}, {1, 0, 0, mass = 1}},\n"
       "                  springs = {{1, 2, k = 100}}}\n"
       "io.stderr:write('going\\n')\n"
       "s.run(m, {duration = 1e5}, {step = 1e-9, frame_rate = 0})"},
      "going\n");
  CHECK(ran.exit_code == 130);
  CHECK_THAT(ran.err, Contains("interrupted"));
}
