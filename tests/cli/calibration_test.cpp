// Options of calibration in scripts and in springlod convert.

#include <filesystem>

#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::test::obj_of_boxes;
using springlod::test::Ran;
using springlod::test::slurp;
using springlod::test::spit;
using springlod::test::springlod_interrupted;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace fs = std::filesystem;

namespace {

const char* const kBar =
    "local s = require 'springlod'\n"
    "local bar = s.lattice(s.grid{cell = '10 cm', size = {6, 3, 3},\n"
    "  materials = {rubber = {young = '1 MPa'}}, fill = function() return 'rubber' end})\n"
    "local function fit(calibration, more)\n"
    "  local options = {levels = 1, calibrate = 'modes', calibration = calibration}\n"
    "  for key, value in pairs(more or {}) do options[key] = value end\n"
    "  return s.simplify(bar, options)\n"
    "end\n";

}  // namespace

TEST_CASE("scripts set regions of interest and weights") {
  const Ran ran = springlod_run({"-q", "-e", std::string(kBar) + R"(
    local function foot(node) return node.x < 0.01 end
    local chain = fit{regions = {{nodes = foot, weight = 2, patches = 6}}, mode_weight = 2,
                      load_weight = 0.5, iterations = 3}
    print(#s.info(s.certify(chain, {within = foot})).levels[2].certificate.loads > 9)
    local function refused(calibration)
      local ok, why = pcall(fit, calibration)
      print(ok, tostring(why))
    end
    refused{regions = {{}}}
    refused{regions = {{nodes = {0}}}}
    refused{regions = 3}
    refused{regions = {{nodes = foot}}, targets = "modes"}
    refused{regions = {{nodes = foot}}, anchored = foot}
    refused{load_weight = -2}
    refused{store = "out/kept", keep_every = "-1 s"}
    refused{mode_weight = 0, shape_weight = 0, load_weight = 0}
    local many = {}
    for i = 1, 50 do many[i] = {nodes = {1}, patches = 1} end
    print("many", #s.info(fit{regions = many, iterations = 1}).levels)
    print(pcall(s.certify, chain, {within = {10000}})))"});
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("true\n"));
  for (const char* reason :
       {"calibration: regions[1]: nodes must be given",
        "regions[1]: nodes[1] must be a node number", "regions must be a list of Region tables",
        "targets = \"modes\" excludes the loads of regions",
        "nodes of region 1 is a border node that is free to move",
        "load_weight must be from 0 to 1000000, got -2", "keep_every must be from 0",
        "no targets are left", "many\t2", "certify: within[1] must be a node number"})
    CHECK_THAT(ran.out, Contains(reason));
}

TEST_CASE("calibration keeps its state in a store and reports stores that it cannot use") {
  const TemporaryFolder scratch;
  spit(scratch / "file", "no folder");
  const std::string code = std::string(kBar) +
                           "local options = {store = arg[1], iterations = 4, patches = 5}\n"
                           "local first, again = fit(options), fit(options)\n"
                           "print(first[1].mass == again[1].mass, #s.files(arg[1]))\n"
                           "print(pcall(fit, {store = arg[2]}))";
  spit(scratch / "fit.lua", code);
  const Ran ran = springlod_run({"run", (scratch / "fit.lua").string(), "--",
                                 (scratch / "store").string(), (scratch / "file/store").string()});
  CAPTURE(ran.out, ran.err);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("true\t3\n"));
  CHECK_THAT(ran.out, Contains("its state cannot be saved in"));
  CHECK_THAT(ran.err, Contains("resumes from"));
}

TEST_CASE("convert resumes an interrupted calibration and ends with the same levels", "[long]") {
  const TemporaryFolder scratch;
  spit(scratch / "bar.obj", obj_of_boxes({{"bar", 0, 3}}));
  const auto arguments = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> all{"convert",     (scratch / "bar.obj").string(),
                                 "-o",          (scratch / name).string(),
                                 "--unit",      "m",
                                 "--cell",      "20cm",
                                 "--keep",      "0.4",
                                 "--grouping",  "compact",
                                 "--calibrate", "modes"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const auto bytes = [&](const std::string& name) { return slurp(scratch / name); };
  const Ran whole = springlod_run(arguments("whole.glb", {}));
  CAPTURE(whole.err);
  REQUIRE(whole.exit_code == 0);
  CHECK_FALSE(fs::exists(scratch / "whole.calibration"));

  const Ran stopped = springlod_interrupted(arguments("bar.glb", {"-v"}), "level 1, step 3:");
  CAPTURE(stopped.err);
  CHECK(stopped.exit_code == 130);
  CHECK_THAT(stopped.err, Contains("its state is saved in"));
  CHECK(fs::exists(scratch / "bar.calibration/level-1-part-1.bin"));
  CHECK_FALSE(fs::exists(scratch / "bar.glb"));
  const Ran resumed = springlod_run(arguments("bar.glb", {}));
  CHECK(resumed.exit_code == 0);
  CHECK_THAT(resumed.err, Contains("resumes from"));
  CHECK(bytes("bar.glb") == bytes("whole.glb"));
  CHECK_FALSE(fs::exists(scratch / "bar.calibration"));
}

TEST_CASE(
    "convert keeps a calibration in a folder of the user's own, and uses none of another base") {
  const TemporaryFolder scratch;
  const auto convert = [&](double length) {
    spit(scratch / "bar.obj", obj_of_boxes({{"bar", 0, length}}));
    return springlod_run({"convert", (scratch / "bar.obj").string(), "-o",
                          (scratch / "bar.glb").string(), "--unit", "m", "--cell", "25cm",
                          "--levels", "1", "--calibrate", "modes", "--resume",
                          (scratch / "kept/").string()});
  };
  CHECK(convert(1).exit_code == 0);
  CHECK(fs::exists(scratch / "kept/bar/level-1-part-1.bin"));
  CHECK_FALSE(fs::exists(scratch / "bar.calibration"));
  CHECK_THAT(convert(1).err, Contains("resumes from"));
  const Ran other = convert(1.5);
  CHECK(other.exit_code == 0);
  CHECK_THAT(other.err, Contains("belongs to another base"));
}
