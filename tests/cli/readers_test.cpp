// The readers for other programs, readers/springlod.py and readers/springlod.mjs, on assets that
// the program wrote. What they read is compared with what model/asset reads.

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "base/subprocess.hpp"
#include "model/asset/asset.hpp"
#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using springlod::LodAsset;
using springlod::MassSpringModel;
using springlod::test::Ran;
using springlod::test::slurp;
using springlod::test::source_folder;
using springlod::test::spit;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace fs = std::filesystem;

namespace {

// Arrays as their number of numbers and a sum that depends on their order, in double precision and
// from first to last, so that all languages have the same bits.
constexpr const char* kPython = R"(
import sys
sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[1])
import springlod

FIELDS = """rest mass volume contactArea border material ends restLength stiffness damping
    nodeOfBase cornerNodes termModulus termDampingTime termStart termNode termGradient contactStart
    contactNode contactWeight contactNormal contactPointArea contactStiffness""".split()
SURFACE = "positions indices bindingStart bindingNode bindingWeight".split()

def flat(values):
    for value in values:
        if hasattr(value, "__len__"): yield from flat(value)
        else: yield float(value)

def show(out, name, values):
    count, total = 0, 0.0
    for value in flat(values):
        total += value * (count % 97 + 1)
        count += 1
    print(name, count, repr(total), file=out)

def distance(points, others):
    return max(max(abs(a - b) for a, b in zip(p, q)) for p, q in zip(points, others))

with open(sys.argv[3], "w") as out:
    try: asset = springlod.load(sys.argv[2])
    except (springlod.AssetError, OSError) as e:
        print("refused", e, file=out)
        sys.exit()
    for level in asset.levels:
        assert len(level.nodes) == len(level.rest) and len(level.springs) == len(level.ends)
        for name in FIELDS: show(out, name, getattr(level, name, ()))
        show(out, "young", [m.young for m in level.materials])
        show(out, "stableStep", [level.stableStep or 0])
        if hasattr(level, "baseNode"):
            base = springlod.interpolate(level.baseStart, level.baseNode, level.baseWeight, level.nodes)
            print("base", distance(base, asset.levels[0].nodes), file=out)
    surface = asset.surface
    assert len(surface.vertices) == len(surface.positions)
    for name in SURFACE: show(out, name, getattr(surface, name))
    skin = springlod.interpolate(surface.bindingStart, surface.bindingNode, surface.bindingWeight,
                                 asset.levels[0].nodes)
    print("skin", distance(skin, surface.vertices), file=out)
)";

constexpr const char* kNode = R"(
import {writeFileSync} from "node:fs";
import {pathToFileURL} from "node:url";
const {load, parse, interpolate, AssetError} =
  await import(pathToFileURL(process.argv[2] + "/springlod.mjs"));
const FIELDS = ("rest mass volume contactArea border material ends restLength stiffness damping "
  + "nodeOfBase cornerNodes termModulus termDampingTime termStart termNode termGradient "
  + "contactStart contactNode contactWeight contactNormal contactPointArea contactStiffness")
  .split(" ");
const SURFACE = "positions indices bindingStart bindingNode bindingWeight".split(" ");
let out = "";
const show = (name, values) => {
  let sum = 0;
  values.forEach((value, i) => { sum += value * (i % 97 + 1); });
  out += `${name} ${values.length} ${sum}\n`;
};
const distance = (a, b) => a.reduce((worst, x, i) => Math.max(worst, Math.abs(x - b[i])), 0);
try {
  const asset = await load(process.argv[3]);
  for (const level of asset.levels) {
    for (const name of FIELDS) show(name, level[name] ?? []);
    show("young", level.materials.map((m) => m.young));
    show("stableStep", [level.stableStep ?? 0]);
    if (level.baseNode)
      out += `base ${distance(interpolate(level.baseStart, level.baseNode, level.baseWeight,
        level.nodes), asset.levels[0].nodes)}\n`;
  }
  const {surface} = asset;
  for (const name of SURFACE) show(name, surface[name]);
  out += `skin ${distance(interpolate(surface.bindingStart, surface.bindingNode,
    surface.bindingWeight, asset.levels[0].nodes), surface.vertices)}\n`;
} catch (e) {
  if (!(e instanceof AssetError) && e.code !== "ENOENT") throw e;
  out = `refused ${e.message}\n`;
}
writeFileSync(process.argv[4], out);
)";

/// CRC-32, bit by bit.
std::uint32_t crc32_of(const std::string& bytes) {
  std::uint32_t crc = 0xFFFFFFFF;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xEDB88320 : 0);
  }
  return ~crc;
}

/// A language with a reader and the program that prints what it read.
struct Reader {
  std::string program;
  std::string script;
  std::string source;
};
const std::vector<Reader> kReaders{
    {"python3", "read.py", kPython},  // with numpy, if it is installed
    {"python3", "plain.py", std::string("import sys\nsys.modules['numpy'] = None\n") + kPython},
    {"node", "read.mjs", kNode}};

/// What the reader prints of a file; nothing if its language is not installed.
std::optional<std::string> read_by(const Reader& reader, const fs::path& file,
                                   const TemporaryFolder& scratch) {
  const auto program = springlod::find_program(reader.program);
  if (!program) {
    WARN(reader.program << " is not installed: its reader is not tested");
    return std::nullopt;
  }
  spit(scratch / reader.script, reader.source);
  const fs::path out = scratch / "read.txt";
  const springlod::ProgramResult ran = springlod::run_program(
      *program, {(scratch / reader.script).string(), (source_folder() / "readers").string(),
                 file.string(), out.string()});
  CAPTURE(ran.errors);
  REQUIRE(ran.exit_code == 0);
  return slurp(out);
}

struct Sum {
  std::string name;
  std::size_t count = 0;
  double sum = 0;
};

template <class T>
void add(std::vector<Sum>& sums, const std::string& name, const std::vector<T>& values) {
  Sum& entry = sums.emplace_back(Sum{name});
  const auto take = [&](double value) {
    entry.sum += value * static_cast<double>(entry.count % 97 + 1);
    ++entry.count;
  };
  for (const T& value : values) {
    if constexpr (std::is_arithmetic_v<T>)
      take(static_cast<double>(value));
    else
      for (const auto each : value) take(static_cast<double>(each));
  }
}

/// What a reader must print of the arrays.
std::vector<Sum> sums_of(const LodAsset& asset) {
  std::vector<Sum> sums;
  for (const springlod::Level& level : asset.chain.levels) {
    const MassSpringModel& m = level.model;
    add(sums, "rest", m.rest);
    add(sums, "mass", m.mass);
    add(sums, "volume", m.volume);
    add(sums, "contactArea", m.contact_area);
    add(sums, "border", m.border);
    add(sums, "material", m.material);
    std::vector<std::array<std::uint32_t, 2>> ends;
    for (std::uint32_t s = 0; s < m.spring_count(); ++s) ends.push_back({m.a[s], m.b[s]});
    add(sums, "ends", ends);
    add(sums, "restLength", m.rest_length);
    add(sums, "stiffness", m.stiffness);
    add(sums, "damping", m.damping);
    add(sums, "nodeOfBase", level.of_base.of);
    std::vector<std::array<std::uint32_t, 4>> corners;
    for (const springlod::Corner& corner : m.corners) corners.push_back(corner.node);
    add(sums, "cornerNodes", corners);
    add(sums, "termModulus", m.dilatation.modulus);
    add(sums, "termDampingTime", m.dilatation.damping_time);
    add(sums, "termStart", m.dilatation.start);
    add(sums, "termNode", m.dilatation.node);
    add(sums, "termGradient", m.dilatation.gradient);
    add(sums, "contactStart", m.surface.of_nodes.start);
    add(sums, "contactNode", m.surface.of_nodes.node);
    add(sums, "contactWeight", m.surface.of_nodes.weight);
    add(sums, "contactNormal", m.surface.normal);
    add(sums, "contactPointArea", m.surface.area);
    add(sums, "contactStiffness", m.surface.stiffness);
    std::vector<double> young;
    for (const springlod::Material& material : m.materials) young.push_back(material.young);
    add(sums, "young", young);
  }
  add(sums, "positions", asset.surface.positions);
  add(sums, "indices", asset.surface.triangles);
  add(sums, "bindingStart", asset.surface_of_base.start);
  add(sums, "bindingNode", asset.surface_of_base.node);
  add(sums, "bindingWeight", asset.surface_of_base.weight);
  return sums;
}

/// Compares what was printed with the arrays, and returns the other lines: name and number.
std::vector<std::pair<std::string, double>> check_sums(const std::string& text,
                                                       const LodAsset& asset) {
  const std::vector<Sum> sums = sums_of(asset);
  auto expected = sums.begin();
  std::vector<std::pair<std::string, double>> others;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name;
    std::string count;
    std::string sum;
    words >> name >> count >> sum;
    CAPTURE(line);
    if (name == "stableStep" || name == "base" || name == "skin") {
      others.emplace_back(name, std::strtod((name == "stableStep" ? sum : count).c_str(), nullptr));
      continue;
    }
    REQUIRE(expected != sums.end());
    CHECK(name == expected->name);
    CHECK(count == std::to_string(expected->count));
    const double read = std::strtod(sum.c_str(), nullptr);
    // Slim assets leave the root of the sum of squares to the reader's language.
    if (name == "restLength")
      CHECK(read == Approx(expected->sum).epsilon(1e-14));
    else
      CHECK(read == expected->sum);
    ++expected;
  }
  CHECK(expected == sums.end());
  return others;
}

}  // namespace

TEST_CASE("The readers for Python and JavaScript read what the program wrote, whole and slim",
          "[long]") {
  const TemporaryFolder scratch;
  spit(scratch / "make.lua", R"lua(
    local s = require "springlod"
    local folder = ...
    local mesh = s.import(s.samples .. "/dumbbell.obj", {unit = "dm", up = "z"})
    local function save(name, chain)
      s.save(("%s/%s.glb"):format(folder, name), chain)
      s.save(("%s/%s-slim.glb"):format(folder, name), chain, {slim = true})
      for level, model in ipairs(chain.levels) do
        local sum = 0
        for i, spring in ipairs(model:springs()) do sum = sum + spring.k * ((i - 1) % 97 + 1) end
        print(("%s %d %.17g %.17g"):format(name, level - 1, sum, s.stable_step(model)))
      end
    end
    local materials = {rod = {young = "10 MPa", damping = "1 ms"},
                       rubber = {young = "0.7 MPa", density = 1234.5}}
    local base = s.lattice(s.voxelize(mesh, {cell = "20 cm", materials = materials}))
    save("base", s.simplify(base, {levels = 0}))
    save("merged", s.simplify(base, {levels = 2, contact = "surface"}))
    save("fitted", s.simplify(base, {levels = 1, calibrate = "modes", calibration = {modes = 6}}))
    materials.rubber.poisson = 0.45
    save("volume", s.simplify(s.lattice(s.voxelize(mesh, {cell = "20 cm", materials = materials})),
      {levels = 1}))
    save("cut", s.simplify(s.lattice(s.voxelize(mesh, {cell = "20 cm", materials = materials,
      cut_cells = true})), {levels = 1, contact = "surface"}))
  )lua");
  const Ran made = springlod_run(
      {"--unsafe", "run", (scratch / "make.lua").string(), "--", scratch.path().string()});
  CAPTURE(made.err);
  REQUIRE(made.exit_code == 0);

  struct Printed {
    double stiffness = 0;
    double stable_step = 0;
  };
  std::map<std::pair<std::string, std::size_t>, Printed> of_level;
  std::istringstream lines(made.out);
  std::string of;
  std::size_t number = 0;
  Printed printed;
  while (lines >> of >> number >> printed.stiffness >> printed.stable_step)
    of_level[{of, number}] = printed;

  for (const std::string name : {"base", "merged", "fitted", "volume", "cut"}) {
    for (const bool slim : {false, true}) {
      const fs::path file = scratch / (name + (slim ? "-slim.glb" : ".glb"));
      const LodAsset asset = springlod::load_asset(file);
      if (name == "volume") CHECK_FALSE(asset.chain.levels[1].model.dilatation.empty());
      if (name == "cut") CHECK_FALSE(asset.chain.levels[0].model.surface.empty());
      for (const Reader& reader : kReaders) {
        CAPTURE(name, slim, reader.script);
        const auto text = read_by(reader, file, scratch);
        if (!text) continue;
        std::vector<double> steps;
        for (const auto& [key, value] : check_sums(*text, asset))
          if (key == "stableStep")
            steps.push_back(value);
          else  // [m], of 2.3 m; nodes far outside the nodes of a level are projected back
            CHECK(value < (key == "base" ? 0.02 : 1e-3));
        REQUIRE(steps.size() == asset.chain.levels.size());
        for (std::size_t level = 0; level < steps.size(); ++level) {
          const Printed& of_whole = of_level.at({name, level});
          // A whole asset has the steps of measured levels alone.
          if (slim || name == "fitted")
            CHECK(steps[level] == Approx(of_whole.stable_step).epsilon(1e-12));
          else
            CHECK(steps[level] == 0);
          double sum = 0;
          const std::vector<double>& stiffness = asset.chain.levels[level].model.stiffness;
          for (std::size_t spring = 0; spring < stiffness.size(); ++spring)
            sum += stiffness[spring] * static_cast<double>(spring % 97 + 1);
          CHECK(sum == Approx(of_whole.stiffness).epsilon(slim ? 1e-7 : 0));
        }
      }
    }
  }
}

TEST_CASE("The readers refuse damaged files, other files and files of a newer version", "[long]") {
  const TemporaryFolder scratch;
  springlod::test::make_bar_asset(scratch / "bar.glb", 3, {"--cell", "1"});
  const Ran slim = springlod_run({"slim", (scratch / "bar.glb").string()});
  REQUIRE(slim.exit_code == 0);
  for (const char* name : {"bar.glb", "bar-slim.glb"}) {
    const std::string whole = slurp(scratch / name);
    const auto with = [&](const std::string& before, const std::string& after) {
      std::string file = whole;
      const std::size_t at = file.find(before);
      REQUIRE(at != std::string::npos);
      return file.replace(at, before.size(), after);
    };
    std::string flipped = whole;
    flipped[whole.find("BIN") + 100] ^= 1;
    std::string no_text = whole;
    no_text[100] = '\xFF';
    const std::vector<std::pair<std::string, std::string>> wrong{
        {"", "not a .glb file"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "not a .glb file"},
        {whole.substr(0, 40), "cut short"},
        {whole.substr(0, whole.size() - 4), "cut short"},
        {whole + "more", "cut short"},
        {flipped, "checksum"},
        {no_text, "damaged"},
        {with("\"young\":1", "\"young\":2"), "checksum"},
        {with("\"byteLength\":", "\"byteLengtg\":"), "damaged"},
        {with("SPRINGLOD_lod_chain\":{", "SPRINGLOD_lod_chaim\":{"), "not a springlod asset"},
        {with("\"bufferViews\"", "\"bufferView_\""), "damaged"},
        {with("glTF\2", "glTF\3"), "damaged"}};
    for (const Reader& reader : kReaders) {
      for (const auto& [file, reason] : wrong) {
        CAPTURE(name, reader.script, reason);
        spit(scratch / "wrong.glb", file);
        const auto text = read_by(reader, scratch / "wrong.glb", scratch);
        if (!text) break;
        CHECK_THAT(*text, StartsWith("refused ") && Contains("wrong.glb") && Contains(reason));
        CHECK(text->size() < 400);
      }
      std::string newer = with("\"version\":6", "\"version\":7");
      const std::size_t digits = newer.find("crc32:") + 6;
      newer.replace(digits, 8, 8, '0');
      newer.replace(digits, 8, fmt::format("{:08x}", crc32_of(newer)));
      spit(scratch / "newer.glb", newer);
      if (const auto text = read_by(reader, scratch / "newer.glb", scratch))
        CHECK_THAT(*text, StartsWith("refused ") && Contains("version 7") &&
                              Contains("take a newer springlod."));
      for (const char* old : {"version_1.glb", "version_2.glb", "version_5.glb"})
        if (const auto text = read_by(reader, source_folder() / "tests/golden" / old, scratch))
          CHECK_THAT(*text, StartsWith("refused ") && Contains("not ") && Contains("version") &&
                                Contains("springlod slim") && !Contains("damaged"));
      if (const auto text = read_by(reader, scratch / "missing.glb", scratch))
        CHECK_THAT(*text, StartsWith("refused ") && Contains("missing.glb"));
    }
  }
}

TEST_CASE("The first example of asset-format.md works in Python and JavaScript", "[long]") {
  const std::string page = slurp(source_folder() / "docs/asset-format.md");
  const auto blocks = [&](const std::string& language) {
    std::string text;
    const std::string fence = "```" + language + "\n";
    for (std::size_t at = page.find(fence); at != std::string::npos; at = page.find(fence, at)) {
      at += fence.size();
      text += page.substr(at, page.find("```", at) - at);
    }
    return text;
  };
  const TemporaryFolder scratch;
  spit(scratch / "page.lua", blocks("lua"));
  const Ran made = springlod_run({"-q", "run", "page.lua"}, "", scratch.path());
  CAPTURE(made.err);
  REQUIRE(made.exit_code == 0);
  for (const char* reader : {"springlod.py", "springlod.mjs"})
    fs::copy_file(source_folder() / "readers" / reader, scratch / reader);
  // Their output is checked by assertions: run_program drops it.
  spit(scratch / "page.py", blocks("py") +
                                "assert len(level.springs) > 0 and level.stableStep > 0\n"
                                "assert len(vertices) == len(asset.levels[0].nodes) == 112\n");
  spit(scratch / "page.mjs", blocks("js") +
                                 "if (!(level.springs.length > 0 && level.stableStep > 0)) "
                                 "throw new Error('no springs');\n");
  for (const auto& [name, script] : {std::pair{"python3", "page.py"}, {"node", "page.mjs"}}) {
    const auto program = springlod::find_program(name);
    if (!program) {
      WARN(name << " is not installed: its example is not tested");
      continue;
    }
    const springlod::ProgramResult ran = springlod::run_program(*program, {script}, scratch.path());
    CAPTURE(name, ran.errors);
    CHECK(ran.exit_code == 0);
  }
}
