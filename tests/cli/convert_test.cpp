#include <map>
#include <set>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using nlohmann::json;
using springlod::test::obj_of_boxes;
using springlod::test::obj_of_open_box;
using springlod::test::Ran;
using springlod::test::slurp;
using springlod::test::spit;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace fs = std::filesystem;

namespace {

const char* const kMaterials =
    "return {rod = {young = '10 MPa', density = 1200, damping = '1 ms', colour = '#ff0000'},\n"
    "        joint = {young = '0.2 MPa', density = 1000}}\n";

// Rod, joint, rod: 12 x 4 x 4 cells of 1 cm.
std::string small_dumbbell() {
  return obj_of_boxes({{"rod", 0, 5}, {"joint", 5, 7}, {"rod_2", 7, 12}}, 4);
}

}  // namespace

TEST_CASE("convert writes an asset and prints its levels, info prints its contents") {
  const TemporaryFolder scratch;
  spit(scratch / "bar.obj", small_dumbbell());
  spit(scratch / "materials.lua", kMaterials);
  const std::string asset = (scratch / "out/bar.glb").string();
  const Ran ran = springlod_run({"convert",     (scratch / "bar.obj").string(),
                                 "-o",          asset,
                                 "--cell",      "1cm",
                                 "--unit",      "cm",
                                 "--up",        "z",
                                 "--materials", (scratch / "materials.lua").string(),
                                 "--lattice",   "centers",
                                 "--levels",    "2",
                                 "--grouping",  "priority",
                                 "--border",    "weak",
                                 "--seed",      "3"});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("stable step") && Contains(" us\n"));
  CHECK_THAT(ran.out, Contains("192"));

  const Ran info = springlod_run({"info", asset, "--json"});
  REQUIRE(info.exit_code == 0);
  const json parsed = json::parse(info.out);
  const json& levels = parsed.at("levels");
  REQUIRE(levels.size() == 3);
  for (const json& level : levels)
    for (const char* key : {"nodes", "springs", "ends", "corners", "border_nodes", "mass",
                            "center_of_mass", "inertia", "stable_dt", "materials"})
      CHECK(level.contains(key));
  const json& base = levels.at(0);
  CHECK(base.at("nodes") == 12 * 4 * 4);
  CHECK(base.at("ends") == 2 * base.at("springs").get<int>());
  CHECK(base.at("mass").get<double>() == Approx(80e-6 * 1200 + 32e-6 * 1000 + 80e-6 * 1000));
  CHECK(base.at("center_of_mass").size() == 3);
  CHECK(base.at("inertia").at(2).size() == 3);
  CHECK(base.at("stable_dt").get<double>() > 0);
  CHECK(base.at("materials").at(0).at("young").get<double>() == 10e6);
  CHECK(levels.at(1).at("nodes").get<int>() < base.at("nodes").get<int>());
  CHECK(levels.at(2).at("mass").get<double>() == Approx(base.at("mass").get<double>()));
  CHECK_THAT(parsed.at("provenance").at("simplify").get<std::string>(), Contains("seed 3"));
  CHECK(parsed.at("provenance").at("mesh") == "bar.obj");

  const Ran text = springlod_run({"info", asset});
  CHECK(text.exit_code == 0);
  CHECK_THAT(text.out, Contains("192 -> "));
}

TEST_CASE("convert gives the levels corners unless it is told to leave them out") {
  const TemporaryFolder scratch;
  spit(scratch / "bar.obj", small_dumbbell());
  const auto corners = [&](std::vector<std::string> options) {
    const std::string asset = (scratch / "bar.glb").string();
    options.insert(options.begin(), {"convert", (scratch / "bar.obj").string(), "-o", asset,
                                     "--cell", "1cm", "--unit", "cm", "--fast"});
    const Ran ran = springlod_run(options);
    CAPTURE(ran.err);
    REQUIRE(ran.exit_code == 0);
    CHECK_THAT(ran.out, Contains("corners"));
    CHECK_THAT(springlod_run({"info", asset}).out, Contains("corners"));
    std::vector<int> counts;
    const json info = json::parse(springlod_run({"info", asset, "--json"}).out);
    for (const json& level : info.at("levels")) counts.push_back(level.at("corners").get<int>());
    return counts;
  };
  const std::vector<int> with = corners({});
  REQUIRE(with.size() == 3);
  CHECK(with[0] == 8 * 12 * 4 * 4);
  CHECK(with[1] > with[2]);
  CHECK(with[2] > 0);
  CHECK(corners({"--no-volumes"}) == std::vector<int>{0, 0, 0});
}

TEST_CASE("convert --cut-cells keeps the volume of the mesh and the points of its surface") {
  const TemporaryFolder scratch;
  const std::string ball = (springlod::test::source_folder() / "samples/ball.obj").string();
  const Ran ran = springlod_run({"-q", "convert", ball, "-o", (scratch / "ball.glb").string(),
                                 "--cell", "8cm", "--unit", "dm", "--cut-cells", "--fast"});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  const Ran checked = springlod_run({"-q", "-e", R"(
    local s = require "springlod"
    local chain = s.load("ball.glb")
    local volume = 0  -- the shell's: the core lies in it
    for _, solid in ipairs(s.import(arg[1], {unit = "dm"}).solids) do
      volume = math.max(volume, solid.volume)
    end
    assert(math.abs(chain[0].volume / volume - 1) < 5e-3, chain[0].volume / volume)
    assert(chain[0].contact_point_count > 100)
    assert(chain[1].contact_point_count == 0))",
                                     ball},
                                    "", scratch.path());
  CAPTURE(checked.err);
  CHECK(checked.exit_code == 0);
  CHECK_THAT(springlod_run({"info", (scratch / "ball.glb").string()}).out,
             Contains(" points of the true surface (cut cells)"));
}

TEST_CASE("convert --bending corrected moves the mass of the surface inwards") {
  const TemporaryFolder scratch;
  spit(scratch / "bar.obj", small_dumbbell());
  for (const char* bending : {"plain", "corrected"}) {
    const Ran ran = springlod_run({"-q", "convert", (scratch / "bar.obj").string(), "-o",
                                   (scratch / bending).string() + ".glb", "--cell", "1cm", "--unit",
                                   "cm", "--fast", "--bending", bending});
    CAPTURE(ran.err);
    REQUIRE(ran.exit_code == 0);
  }
  const Ran compared = springlod_run({"-q", "-e", R"(
    local s = require "springlod"
    local plain, corrected = s.load("plain.glb")[0], s.load("corrected.glb")[0]
    assert(plain.spring_count == corrected.spring_count)
    assert(math.abs(plain.mass - corrected.mass) < 1e-9 * plain.mass)
    local ratio = corrected:node(1).mass / plain:node(1).mass
    assert(math.abs(ratio - (5 / 6) ^ 3) < 1e-9, ratio))"},
                                     "", scratch.path());
  CAPTURE(compared.err);
  CHECK(compared.exit_code == 0);
  const Ran refused =
      springlod_run({"convert", (scratch / "bar.obj").string(), "-o", (scratch / "c.glb").string(),
                     "--paper", "--bending", "corrected"});
  CHECK(refused.exit_code == 1);
  CHECK_THAT(refused.err, Contains("is for --lattice corners"));
}

TEST_CASE("convert writes identical files for any number of threads", "[long]") {
  const TemporaryFolder scratch;
  spit(scratch / "bar.obj", small_dumbbell());
  const auto convert = [&](const std::string& name, const std::string& threads) {
    const Ran ran =
        springlod_run({"--threads", threads, "convert", (scratch / "bar.obj").string(), "-o",
                       (scratch / name).string(), "--cell", "1cm", "--unit", "cm", "-q"});
    CHECK(ran.exit_code == 0);
    CHECK(ran.err.empty());
    return slurp(scratch / name);
  };
  const std::string first = convert("one.glb", "1");
  CHECK(first == convert("two.glb", "1"));
  CHECK(first == convert("three.glb", "2"));
}

TEST_CASE("convert fits and certifies levels by default, and only merges with --fast or --paper") {
  const TemporaryFolder scratch;
  spit(scratch / "bar.obj", obj_of_boxes({{"bar", 0, 2}}));
  const auto convert = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{
        "convert", (scratch / "bar.obj").string(), "-o", (scratch / name).string(), "-q", "--cell",
        "25cm"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ran ran = springlod_run(arguments);
    CAPTURE(ran.err);
    CHECK(ran.exit_code == 0);
    return ran.out;
  };
  const auto info = [&](const std::string& name) {
    return json::parse(springlod_run({"info", (scratch / name).string(), "--json"}).out);
  };
  CHECK_THAT(convert("best.glb", {}), Contains("f1..10") && Contains("level 1 is "));
  CHECK(info("best.glb").at("contact") == "surface");
  CHECK(info("best.glb").at("levels").at(1).at("made_by") ==
        "compact, border none, seed 1, calibrated");
  CHECK(info("best.glb").at("levels").at(2).contains("certificate"));
  convert("fast.glb", {"--fast"});
  CHECK(info("fast.glb").at("contact") == "surface");
  CHECK(info("fast.glb").at("levels").at(1).at("made_by") == "compact, border none, seed 1");
  CHECK_FALSE(info("fast.glb").at("levels").at(1).contains("certificate"));
  convert("paper.glb", {"--paper", "--border", "weak"});
  CHECK(info("paper.glb").at("contact") == "nodes");
  CHECK(info("paper.glb").at("levels").at(1).at("made_by") == "standard, border weak, seed 1");
  CHECK(info("paper.glb").at("levels").at(0).at("corners") == 0);
  CHECK(info("paper.glb").at("levels").at(0).at("nodes") == 8 * 4 * 4);
  convert("moduli.glb", {"--calibrate", "moduli", "--keep", "0.4", "--contact", "nodes"});
  CHECK(info("moduli.glb").at("contact") == "nodes");
  CHECK(info("moduli.glb").at("levels").size() == 2);
  const Ran refused = springlod_run({"convert", (scratch / "bar.obj").string(), "-o",
                                     (scratch / "full.glb").string(), "--calibrate", "full"});
  CHECK(refused.exit_code == 2);
  CHECK_FALSE(fs::exists(scratch / "full.glb"));
}

TEST_CASE("convert takes every option of simplify") {
  const Ran ran = springlod_run({"-e", R"(
    local s = require "springlod"
    for _, record in ipairs{"simplify", "Calibration", "Guard"} do
      for _, option in ipairs(s.options_of(record)) do
        local on = option.type == "boolean" and option.default == "true"
        print((on and "--no-" or "--") .. option.name:gsub("_", "-"))
      end
    end
  )"});
  REQUIRE(ran.exit_code == 0);
  const std::string convert = springlod_run({"convert", "--help"}).out;
  const std::string compare = springlod_run({"compare", "--help"}).out;
  std::istringstream names(ran.out);
  int count = 0;
  // Tables, whose keys are options; and what has another name.
  const std::set<std::string> other{"--calibration", "--guard", "--seed", "--store",
                                    "--keep-every"};
  for (std::string name; std::getline(names, name); ++count) {
    if (other.contains(name)) continue;
    CAPTURE(name);
    CHECK_THAT(convert, Contains("   " + name));
    CHECK_THAT(compare, Contains("   " + name));
  }
  CHECK(count > 25);
}

TEST_CASE("options of convert reach simplify") {
  const TemporaryFolder scratch;
  spit(scratch / "bar.obj", obj_of_boxes({{"bar", 0, 3}}));
  spit(scratch / "cost.lua", "return function(a, b) return math.abs(a.z - b.z) end");
  spit(scratch / "regions.lua",
       "return {{nodes = function(node) return node.x < 0.01 end, patches = 4}}");
  const auto convert = [&](const std::string& name, std::vector<std::string> more) {
    more.insert(more.begin(), {"convert", (scratch / "bar.obj").string(), "-o",
                               (scratch / name).string(), "-q", "--cell", "25cm"});
    const Ran ran = springlod_run(more);
    CAPTURE(ran.err);
    CHECK(ran.exit_code == 0);
  };
  convert("cli.glb", {"--keep", "0.4", "--masses", "free", "--iterations", "3", "--patches", "6",
                      "--regions", (scratch / "regions.lua").string(), "--grading", "0.2"});
  convert("cost.glb", {"--fast", "--grouping", "standard", "--levels", "1", "--pair-cost",
                       (scratch / "cost.lua").string(), "--no-guards"});
  spit(scratch / "same.lua", R"(
    local s = require "springlod"
    local base = s.lattice(s.voxelize(s.import(arg[1] .. "/bar.obj"), {cell = "25cm"}))
    local function same(name, options)
      options.contact = "surface"
      print(s.inspect(s.load(arg[1] .. "/" .. name)[1]:springs()) ==
            s.inspect(s.simplify(base, options)[1]:springs()))
    end
    same("cli.glb", {keep = {0.4}, grouping = "compact", calibrate = "modes", grading = 0.2,
      calibration = {masses = "free", iterations = 3, patches = 6,
                     regions = dofile(arg[1] .. "/regions.lua")}})
    same("cost.glb", {levels = 1, pair_cost = dofile(arg[1] .. "/cost.lua"), guards = false})
  )");
  const Ran same =
      springlod_run({"run", (scratch / "same.lua").string(), "--", scratch.path().string()});
  CAPTURE(same.err);
  CHECK(same.out == "true\ntrue\n");
}

TEST_CASE("an asset tells the command that makes it again, to the same bytes") {
  const TemporaryFolder scratch;
  spit(scratch / "two bars/bar.obj", obj_of_boxes({{"bar", 0, 2}}));
  spit(scratch / "two bars/other.obj", obj_of_boxes({{"bar", 0, 3}}));
  const std::string folder = (scratch / "two bars").string();
  const Ran ran = springlod_run({"convert", folder, "-o", (scratch / "out").string(), "--fast",
                                 "--cell", "25cm", "--keep=0.4,0.2", "--seed", "5", "-q"});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  const std::string asset = (scratch / "out/bar.glb").string();
  const json info = json::parse(springlod_run({"info", asset, "--json"}).out);
  const std::string command = info.at("provenance").at("command").get<std::string>();
  CHECK(command ==
        "springlod convert '" + folder + "/bar.obj' --fast --cell 25cm --keep=0.4,0.2 --seed 5");
  CHECK_THAT(springlod_run({"info", asset}).out, Contains(command + " -o " + asset));
  const Ran again =
      springlod_run({"convert", folder + "/bar.obj", "--fast", "--cell", "25cm", "--keep=0.4,0.2",
                     "--seed", "5", "-o", (scratch / "again.glb").string(), "-q"});
  REQUIRE(again.exit_code == 0);
  CHECK(slurp(scratch / "again.glb") == slurp(asset));
}

TEST_CASE("convert puts a core of a material under a shell") {
  const TemporaryFolder scratch;
  spit(scratch / "bar.obj", obj_of_boxes({{"bar", 0, 1}}));
  spit(scratch / "materials.lua", "return {skin = {young = '1 MPa'}, bone = {young = '9 MPa'}}");
  const auto convert = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"convert", (scratch / "bar.obj").string(), "-o",
                               (scratch / "bar.glb").string(), "-q", "--fast", "--cell", "125mm",
                               "--materials", (scratch / "materials.lua").string()});
    return springlod_run(more);
  };
  const Ran ran = convert({"--core", "bone", "--shell", "30cm"});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  const json info =
      json::parse(springlod_run({"info", (scratch / "bar.glb").string(), "--json"}).out);
  std::map<std::string, double> young;
  for (const json& material : info.at("levels").at(0).at("materials"))
    young[material.at("name")] = material.at("young");
  CHECK(young == std::map<std::string, double>{{"bone", 9e6}, {"default", 1e6}});
  CHECK_THAT(convert({"--core", "bone"}).err, Contains("--shell THICKNESS belong together"));
  CHECK_THAT(convert({"--core", "bine", "--shell", "1cm"}).err,
             Contains("has no material of this name"));
}

TEST_CASE("convert prints the default cell size and unit") {
  const TemporaryFolder scratch;
  spit(scratch / "bar.obj", obj_of_boxes({{"bar", 0, 2}}));
  const Ran ran = springlod_run({"convert", (scratch / "bar.obj").string(), "-o",
                                 (scratch / "bar.glb").string(), "--levels", "1", "--fast"});
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.err, Contains("62.5 mm"));
  CHECK_THAT(ran.err, Contains("1 unit = 1 m"));
}

TEST_CASE("convert reports an invalid mesh in one line") {
  const TemporaryFolder scratch;
  spit(scratch / "empty.obj", "");
  spit(scratch / "picture.png", "\x89PNG\r\n\x1a\n nothing");
  spit(scratch / "open.obj", obj_of_open_box());
  spit(scratch / "bar.obj", obj_of_boxes({{"bar", 0, 2}}));
  const auto refused = [&](const std::string& name, const std::vector<std::string>& more,
                           const std::string& reason) {
    std::vector<std::string> arguments{"convert", (scratch / name).string(), "-o",
                                       (scratch / "x.glb").string(), "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ran ran = springlod_run(arguments);
    CAPTURE(ran.err);
    CHECK(ran.exit_code == 1);
    CHECK(ran.out.empty());
    CHECK_THAT(ran.err, Contains("springlod: cannot "));
    CHECK_THAT(ran.err, Contains(reason));
    CHECK_THAT(ran.err, !Contains("traceback"));
    CHECK_FALSE(fs::exists(scratch / "x.glb"));
  };
  refused("none.obj", {}, "none.obj");
  refused("empty.obj", {}, "empty.obj");
  refused("picture.png", {}, "picture.png");
  refused("open.obj", {"--repair", "strict"}, "1 hole (4 open edges");
  refused("open.obj", {"--repair", "off"}, "is not closed");
  refused("bar.obj", {"--cell", "100 m"}, "cell");
  refused("bar.obj", {"--materials", (scratch / "none.lua").string()}, "none.lua");

  spit(scratch / "wrong.lua", "return {bar = {yuong = 1}}");
  refused("bar.obj", {"--materials", (scratch / "wrong.lua").string()}, "did you mean 'young'?");

  const Ran verbose = springlod_run({"convert", (scratch / "open.obj").string(), "-o",
                                     (scratch / "x.glb").string(), "--repair", "off", "-v"});
  CHECK_THAT(verbose.err, Contains("traceback"));
}

TEST_CASE("convert --levels 0 writes the base alone, without a fit") {
  const TemporaryFolder scratch;
  spit(scratch / "open.obj", obj_of_open_box());
  const std::string asset = scratch / "base.glb";
  const Ran ran = springlod_run(
      {"convert", scratch / "open.obj", "-o", asset, "--cell", "5cm", "--levels", "0"});
  INFO(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.err, !Contains("fit"));
  CHECK(json::parse(springlod_run({"info", asset, "--json"}).out).at("levels").size() == 1);
}

TEST_CASE("convert takes node counts as fractions or percentages") {
  const TemporaryFolder scratch;
  spit(scratch / "open.obj", obj_of_open_box());
  const auto nodes = [&](const std::string& keep) {
    const std::string asset = scratch / "keep.glb";
    const Ran ran = springlod_run(
        {"convert", scratch / "open.obj", "-o", asset, "--cell", "25cm", "--fast", "--keep", keep});
    INFO(ran.err);
    CHECK(ran.exit_code == 0);
    return json::parse(springlod_run({"info", asset, "--json"}).out).at("levels").at(1).at("nodes");
  };
  CHECK(nodes("45%") == nodes("0.45"));
  const Ran bare = springlod_run({"convert", scratch / "open.obj", "--keep", "45,20"});
  CHECK(bare.exit_code == 2);
  CHECK_THAT(bare.err, Contains("--keep: '45' must be above 0 and at most 1; write 45%"));
}

TEST_CASE("convert closes a hole, says so, and the asset keeps it") {
  const TemporaryFolder scratch;
  spit(scratch / "open.obj", obj_of_open_box());
  const std::string asset = (scratch / "tub.glb").string();
  const Ran ran = springlod_run({"convert", (scratch / "open.obj").string(), "-o", asset, "--cell",
                                 "0.1", "--levels", "1", "--fast"});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  CHECK_THAT(ran.err, Contains("part \"tub\": 1 hole (4 open edges, 1e+04 cm2) closed"));
  const Ran info = springlod_run({"info", asset});
  CHECK_THAT(info.out, Contains("repair") && Contains("1 hole"));
}

TEST_CASE("convert does not overwrite its mesh") {
  const TemporaryFolder scratch;
  const std::string mesh = (scratch / "mesh.glb").string();
  const std::string bytes = "glTF, or what is to become one";
  spit(mesh, bytes);
  fs::create_symlink(mesh, scratch / "link.glb");
  for (const std::string& output : {mesh, (scratch / "link.glb").string()}) {
    const Ran ran = springlod_run({"convert", mesh, "-o", output});
    CHECK(ran.exit_code == 1);
    CHECK_THAT(ran.err, Contains("would overwrite") && Contains("-o"));
    CHECK(slurp(mesh) == bytes);
  }
}

TEST_CASE("a batch continues after a bad mesh and ends with a table") {
  const TemporaryFolder scratch;
  spit(scratch / "meshes/a.obj", obj_of_boxes({{"a", 0, 2}}));
  spit(scratch / "meshes/b.obj", "this is no mesh\n");
  spit(scratch / "meshes/c.obj", obj_of_boxes({{"c", 0, 1}}));
  spit(scratch / "meshes/notes.txt", "not a mesh, not looked at");
  const std::string out = (scratch / "assets").string();
  const Ran ran = springlod_run({"convert", (scratch / "meshes").string(), "-o", out, "--cell",
                                 "0.25", "--levels", "1", "-q"});
  CAPTURE(ran.out, ran.err);
  CHECK(ran.exit_code == 1);
  CHECK(fs::exists(scratch / "assets/a.glb"));
  CHECK_FALSE(fs::exists(scratch / "assets/b.glb"));
  CHECK(fs::exists(scratch / "assets/c.glb"));
  CHECK_THAT(ran.out, Contains("a.obj") && Contains("b.obj") && Contains("c.obj"));
  CHECK_THAT(ran.out, Contains("failed") && Contains("converted") && !Contains("notes.txt"));
  CHECK_THAT(ran.err, Contains("1 of 3 meshes failed"));

  const Ran good = springlod_run({"convert", (scratch / "meshes/a.obj").string(),
                                  (scratch / "meshes/c.obj").string(), "-o", out, "--cell", "0.25",
                                  "--levels", "1", "-q"});
  CHECK(good.exit_code == 0);
  CHECK(springlod_run({"convert", (scratch / "meshes").string(), "-o", out + ".glb"}).exit_code ==
        2);
}
