// springlod new, batches by a manifest, and what is made from the help of the commands.

#include <filesystem>

#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using springlod::test::obj_of_boxes;
using springlod::test::Ran;
using springlod::test::slurp;
using springlod::test::source_folder;
using springlod::test::spit;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

TEST_CASE("new makes a project whose script runs at once and draws pictures", "[long]") {
  const TemporaryFolder scratch;
  const Ran made = springlod_run({"new", "toy"}, "", scratch.path());
  CAPTURE(made.err);
  REQUIRE(made.exit_code == 0);
  CHECK_THAT(made.out, Contains("cd toy\n  springlod run main.lua"));
  for (const char* file : {"README.md", "beast.obj", "main.lua", "materials.lua", "scene.lua"})
    CHECK(fs::file_size(scratch / "toy" / file) > 0);
  CHECK(slurp(scratch / "toy/beast.obj") == slurp(source_folder() / "samples/beast.obj"));
  const Ran ran = springlod_run({"-q", "run", "main.lua"}, "", scratch / "toy");
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("level 2"));
  for (const char* file : {"toy.glb", "levels.png", "frames/frame_0010.png"})
    CHECK(fs::file_size(scratch / "toy/out" / file) > 0);
}

TEST_CASE("new takes a mesh of the user, with its parts, unit and size") {
  const TemporaryFolder scratch;
  spit(scratch / "my car.obj", obj_of_boxes({{"left-wheel", 0, 2}, {"hull", 2, 4}}, 2));
  const Ran ran = springlod_run({"new", "car", "--mesh", "my car.obj", "--unit", "cm", "--up", "y"},
                                "", scratch.path());
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  CHECK(fs::exists(scratch / "car/body.obj"));
  const std::string main = slurp(scratch / "car/main.lua");
  CHECK_THAT(main, Contains("s.import(\"body.obj\", {unit = \"cm\", up = \"y\"})"));
  CHECK_THAT(main, Contains("cell = \"1.2 mm\"") && !Contains("{mesh}"));
  const std::string materials = slurp(scratch / "car/materials.lua");
  CHECK_THAT(materials, Contains("[\"left-wheel\"] = {") && Contains("  hull = {"));
  CHECK_THAT(slurp(scratch / "car/scene.lua"), Contains("\"8 cm\""));
  CHECK(springlod_run({"-e", "assert(dofile('car/materials.lua').hull.preset)"}, "", scratch.path())
            .exit_code == 0);
}

TEST_CASE("new refuses an existing folder, a bad name and a bad mesh, and leaves nothing") {
  const TemporaryFolder scratch;
  spit(scratch / "old/notes.txt", "mine");
  spit(scratch / "junk.obj", "junk");
  const auto refused = [&](const std::vector<std::string>& arguments) {
    const Ran ran = springlod_run(arguments, "", scratch.path());
    CHECK(ran.exit_code == 1);
    return ran.err;
  };
  CHECK_THAT(refused({"new", "old"}), Contains("cannot make old: it exists already"));
  CHECK_THAT(refused({"new", "old/notes.txt"}), Contains("exists already"));
  CHECK_THAT(refused({"new", "a\"b"}), Contains("letters, digits"));
  CHECK_THAT(refused({"new", "fresh", "--mesh", "junk.obj"}), Contains("junk.obj"));
  CHECK_FALSE(fs::exists(scratch / "fresh"));
  CHECK(slurp(scratch / "old/notes.txt") == "mine");
}

TEST_CASE("a manifest gives each mesh its options, and a failed one does not stop the others",
          "[long]") {
  const TemporaryFolder scratch;
  spit(scratch / "bar.obj", obj_of_boxes({{"bar", 0, 4}}));
  spit(scratch / "junk.obj", "junk");
  spit(scratch / "soft.lua", "return {bar = {young = '10 kPa'}}");
  spit(scratch / "list.lua", R"(return {
    unit = "cm",
    {mesh = "bar.obj", cell = "5 mm", materials = "soft.lua", output = "assets/soft.glb"},
    {mesh = "junk.obj", output = "junk.glb"},
    {mesh = "bar.obj", unit = "lightyear", output = "far.glb"},
    {mesh = "bar.obj", unit = "dm", cell = "5 cm", no_volumes = true, keep = {0.5, 0.2}},
    {mesh = "bar.obj", output = "bar.obj"},
    {msh = "bar.obj"},
  })");
  const Ran ran = springlod_run({"-q", "convert", "--manifest", "list.lua", "--fast", "-o", "out"},
                                "", scratch.path());
  CHECK(ran.exit_code == 1);
  CHECK_THAT(ran.err, Contains("4 of 6 meshes failed"));
  CHECK_THAT(ran.out, Contains("cannot read junk.obj") && Contains("list.lua, entry 3: ") &&
                          Contains("'unit' must be one of") && Contains("must end in .glb"));
  const Ran sizes = springlod_run(
      {"-e",
       "s = require 'springlod' a = s.load('assets/soft.glb') b = s.load('out/bar.glb') "
       "print(#a.levels, a[0].materials[1].young, #b.levels, b[0].corner_count, "
       "math.floor(b[0].volume / a[0].volume + 0.5))"},
      "", scratch.path());
  CAPTURE(sizes.err);
  CHECK(sizes.out == "3\t10000.0\t3\t0\t1000\n");

  const auto wrong = [&](const std::string& list) {
    spit(scratch / "wrong.lua", list);
    return springlod_run({"convert", "--manifest", "wrong.lua"}, "", scratch.path());
  };
  CHECK_THAT(wrong("return {mesh = 'bar.obj'}").err,
             Contains("wrong.lua lists no meshes") && Contains("{{mesh = \"bear.obj\"}, ...}"));
  CHECK_THAT(wrong("return {{'bar.obj'}}").out, Contains("entry 1: must be a table with a mesh"));
  CHECK_THAT(wrong("return {{mesh = 'none.obj'}}").out, Contains("none.obj"));
  CHECK_THAT(wrong("return {{mesh = 'bar.obj', cel = '5 mm'}}").out,
             Contains("wrong.lua, entry 1: unknown option 'cel'; did you mean 'cell'?"));
  CHECK_THAT(wrong("return {cut_cell = true, {mesh = 'bar.obj'}}").out,
             Contains("wrong.lua, options of all meshes: unknown option 'cut_cell'") &&
                 Contains("'cut_cells'"));
  CHECK_THAT(wrong("return {{mesh = 'bar.obj', cell = '2kg'}}").out,
             Contains("wrong.lua, entry 1: cell: \"2kg\""));
  CHECK(wrong("return 3").exit_code == 1);
  CHECK(springlod_run({"convert", "bar.obj", "--manifest", "list.lua"}, "", scratch.path())
            .exit_code == 2);
}

TEST_CASE("docs/commands.md, man pages and completion come from the help of the commands") {
  const TemporaryFolder scratch;
  const Ran ran =
      springlod_run({"--unsafe", "run", "docs/make_commands.lua", "--", "--reference",
                     (scratch / "commands.md").string(), "--man", (scratch / "man").string(),
                     "--completion", scratch.path().string()});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  // If not: springlod --unsafe run docs/make_commands.lua -- --reference docs/commands.md
  CHECK((slurp(scratch / "commands.md") == slurp(source_folder() / "docs/commands.md")));
  CHECK_THAT(slurp(scratch / "man/springlod.1"), Contains(".B \\-\\-seed N"));
  const std::string page = slurp(scratch / "man/springlod-convert.1");
  CHECK_THAT(page, Contains("springlod\\-convert \\- Convert meshes to LOD assets\n"));
  CHECK_THAT(page, Contains(".SH CALIBRATION") && Contains(".B \\-\\-unit"));
  CHECK_THAT(slurp(scratch / "springlod.bash"), Contains("--unit) words='m nm um mm cm"));
  CHECK_THAT(slurp(scratch / "springlod.fish"),
             Contains("__fish_seen_subcommand_from convert' -l unit -r -f -a 'm nm um mm cm"));
  // What zsh makes of it is tested in tests/peers/completion, where zsh is installed.
  CHECK_THAT(slurp(scratch / "springlod.zsh"), StartsWith("#compdef springlod\n") &&
                                                   Contains(":unit:(m nm um mm cm") &&
                                                   Contains(":to:(jolt mujoco bullet"));
}
