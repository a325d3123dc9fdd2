// Motions written by the real program, read back by the programs that they are for.

#include <algorithm>
#include <map>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "base/subprocess.hpp"
#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::find_program;
using springlod::run_program;
using springlod::test::Ran;
using springlod::test::slurp;
using springlod::test::source_folder;
using springlod::test::spit;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace {

// A bar of two cells by two by six with its surface, and a level; it falls turned onto a floor.
constexpr const char* kMake = R"lua(
local s = require "springlod"
local mesh = s.import("bar.obj", {unit = "m"})
local grid = s.voxelize(mesh, {cell = "10 cm", materials = {bar = {young = "50 kPa"}}})
local chain = s.simplify(s.lattice(grid), {levels = 1, grouping = "compact"})
s.save("bar.glb", chain)
)lua";
constexpr const char* kScene = R"lua(
return {duration = 0.3, throw = {turn = {axis = {0, 1, 0}, angle = "30 deg"}, position = {0, 0, 0.4}},
  obstacles = {{plane = {0, 0, 1, 0}, friction = 0.5}}}
)lua";
// x, y and z from 0 to 0.2, 0.2 and 0.6 m.
constexpr const char* kBar = R"obj(
o bar
v 0 0 0
v 0.2 0 0
v 0 0.2 0
v 0.2 0.2 0
v 0 0 0.6
v 0.2 0 0.6
v 0 0.2 0.6
v 0.2 0.2 0.6
f 1 3 2
f 2 3 4
f 5 6 7
f 6 8 7
f 1 2 5
f 2 6 5
f 3 7 4
f 4 7 8
f 1 5 3
f 3 5 7
f 2 4 6
f 4 8 6
)obj";

void make_bar(const TemporaryFolder& folder) {
  spit(folder / "bar.obj", kBar);
  spit(folder / "fall.lua", kScene);
  spit(folder / "make.lua", kMake);
  const Ran made = springlod_run({"-q", "run", "make.lua"}, "", folder.path());
  CAPTURE(made.err);
  REQUIRE(made.exit_code == 0);
}

Ran export_bar(const TemporaryFolder& folder, const std::string& format, const std::string& out,
               const std::string& level = "1") {
  return springlod_run({"export", "bar.glb", "--to", format, "--scenario", "fall.lua", "--level",
                        level, "--frame-rate", "30", "-o", out},
                       "", folder.path());
}

void export_all(const TemporaryFolder& folder) {
  make_bar(folder);
  const std::pair<const char*, const char*> kinds[] = {
      {"glb", "skin"},  {"glb_morph", "morph"}, {"pc2", "cache"}, {"mdd", "cache"},
      {"obj", "frame"}, {"vtu", "run"},         {"npz", "arrays"}};
  for (const auto& [format, name] : kinds) {
    const Ran ran = export_bar(folder, format, name);
    CAPTURE(format, ran.err);
    REQUIRE(ran.exit_code == 0);
  }
}

// The output of a program, which must succeed.
std::string output_of(const TemporaryFolder& folder, const std::string& program,
                      std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"-c", "\"$0\" \"$@\" > output.txt", program});
  const auto ran = run_program("/bin/sh", arguments, folder.path());
  const std::string output = slurp(folder / "output.txt");
  CAPTURE(ran.errors, output);
  REQUIRE(ran.exit_code == 0);
  return output;
}

// Lines "NAME NUMBER" or "result NAME NUMBER".
std::map<std::string, double> results_in(const std::string& output) {
  std::map<std::string, double> results;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("result ")) line.erase(0, 7);
    std::istringstream words(line);
    std::string name;
    double value = 0;
    if (words >> name >> value) results[name] = value;
  }
  return results;
}

}  // namespace

TEST_CASE("export writes a motion in every format and says what it holds") {
  const TemporaryFolder folder;
  make_bar(folder);
  const Ran skin = export_bar(folder, "glb", "skin.glb");
  CAPTURE(skin.err);
  REQUIRE(skin.exit_code == 0);
  CHECK_THAT(skin.out, Contains("joints, at most 4 a vertex") && Contains("% of the body's size"));
  CHECK_THAT(skin.out, Contains("not in the file: springs and masses"));
  CHECK(slurp(folder / "skin.glb").starts_with("glTF"));
  const Ran frames = export_bar(folder, "obj", "frame", "0");
  CHECK_THAT(frames.err, Contains("frame_0000.obj and 9 more files"));
  CHECK(std::filesystem::exists(folder / "frame_0009.obj"));
}

TEST_CASE("export names a wrong format, level and scenario of a motion") {
  const TemporaryFolder folder;
  make_bar(folder);
  const Ran model = springlod_run({"export", "bar.glb", "--to", "pc2"}, "", folder.path());
  CHECK(model.exit_code == 2);
  CHECK_THAT(model.err, Contains("motions need --scenario"));
  const Ran motion = export_bar(folder, "json", "x");
  CHECK(motion.exit_code == 2);
  CHECK_THAT(motion.err, Contains("no format of a motion; those are glb"));
  const Ran level = export_bar(folder, "glb", "x", "4");
  CHECK(level.exit_code == 1);
  CHECK_THAT(level.err, Contains("no level 4; its coarsest is 1"));
  CHECK_FALSE(std::filesystem::exists(folder / "x.glb"));
}

TEST_CASE("The Khronos validator finds no error in an exported motion", "[long]") {
  const auto node = find_program("node");
  const auto script = source_folder() / "tests/gltf/validate.mjs";
  if (!node || !std::filesystem::exists(source_folder() / "tests/gltf/node_modules")) {
    WARN("left out: node or the glTF validator is not installed (./dev setup)");
    return;
  }
  const TemporaryFolder folder;
  export_all(folder);
  const std::string output =
      output_of(folder, node->string(),
                {script.string(), (folder / "skin.glb").string(), (folder / "morph.glb").string()});
  CHECK_THAT(output, Contains("skin.glb: 0 errors, 0 warnings") &&
                         Contains("morph.glb: 0 errors, 0 warnings"));
}

TEST_CASE("Blender shows exported motions where the surface is", "[long]") {
  const auto blender = find_program("blender");
  if (!blender) {
    WARN("left out: blender is not installed (./dev setup peers)");
    return;
  }
  const TemporaryFolder folder;
  export_all(folder);
  auto results = results_in(
      output_of(folder, blender->string(),
                {"--background", "--factory-startup", "--python-exit-code", "1", "--python",
                 (source_folder() / "tests/peers/blender_motion.py").string(), "--",
                 folder.path().string()}));
  REQUIRE(results.size() >= 4);
  for (const char* exact : {"pc2", "mdd", "morph.glb"}) {
    CAPTURE(exact);
    CHECK(results.at(exact) < 1e-5);
  }
  // What the export itself says: "... 1.2 % at most".
  const Ran again = export_bar(folder, "glb", "skin");
  const std::size_t end = again.out.find(" % at most");
  const std::size_t start = again.out.rfind(' ', end - 1);
  const double largest = std::stod(again.out.substr(start + 1, end - start - 1)) / 100;
  CHECK(results.at("skin.glb") == Approx(largest).epsilon(0.05));  // printed with two digits
}

TEST_CASE("VTK reads an exported motion as it was simulated", "[long]") {
  // Debian's own: it has Debian's packages, whatever else is found first.
  const std::string python = "/usr/bin/python3";
  if (run_program("/bin/sh", {"-c", python + " -c 'import vtkmodules.vtkIOXML'"}).exit_code != 0) {
    WARN("left out: python3-vtk9 is not installed (./dev setup peers)");
    return;
  }
  const TemporaryFolder folder;
  export_all(folder);
  auto results = results_in(output_of(
      folder, python,
      {(source_folder() / "tests/peers/vtk_motion.py").string(), folder.path().string()}));
  CHECK(results.at("distance") < 1e-12);
  CHECK(results.at("files") == 20);
  const Ran info = springlod_run({"info", "bar.glb", "--json"}, "", folder.path());
  CHECK_THAT(info.out, Contains(fmt::format("\"nodes\": {}", results.at("nodes"))));
  CHECK(results.at("mass") == Approx(0.2 * 0.2 * 0.6 * 1000));
}

TEST_CASE("NumPy reads an exported motion with its times, nodes and surface", "[long]") {
  const std::string python = "/usr/bin/python3";
  if (run_program("/bin/sh", {"-c", python + " -c 'import numpy'"}).exit_code != 0) {
    WARN("left out: python3-numpy is not installed (./dev setup peers)");
    return;
  }
  const TemporaryFolder folder;
  export_all(folder);
  // The surface of the arrays is that of the OBJ sequence, and moves as the nodes do.
  spit(folder / "read.py", R"py(
import glob
import numpy as np
arrays = np.load("arrays.npz")
frames = [np.loadtxt((line[2:] for line in open(path) if line.startswith("v ")))
          for path in sorted(glob.glob("frame_*.obj"))]
print("frames", len(arrays["time"]))
print("last", arrays["time"][-1])
print("distance", np.abs(arrays["surface"] - np.array(frames)).max())
print("nodes", arrays["nodes"].shape[1])
print("axes", arrays["nodes"].shape[2])
print("triangles", len(arrays["triangles"]))
print("fall", arrays["nodes"][0, :, 2].mean() - arrays["nodes"][-1, :, 2].mean())
)py");
  auto results = results_in(output_of(folder, python, {"read.py"}));
  CHECK(results.at("frames") == 10);
  CHECK(results.at("last") == Approx(0.3));
  CHECK(results.at("distance") < 1e-12);
  CHECK(results.at("axes") == 3);
  CHECK(results.at("triangles") == 12);
  CHECK(results.at("fall") > 0.05);
  const Ran info = springlod_run({"info", "bar.glb", "--json"}, "", folder.path());
  CHECK_THAT(info.out, Contains(fmt::format("\"nodes\": {}", results.at("nodes"))));
}
