// `springlod export` of solvers' and viewers' formats, read back by other programs.

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "base/subprocess.hpp"
#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::find_program;
using springlod::run_program;
using springlod::test::Ran;
using springlod::test::source_folder;
using springlod::test::spit;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace {

// Two materials, one of them with dilatation terms; a merged level.
constexpr const char* kMakeAsset = R"(
local s = require "springlod"
local mesh = s.import("bar.obj", {unit = "m", up = "z"})
local grid = s.voxelize(mesh, {cell = 0.5, materials = {
  rod    = {young = 1e7, density = 1200, damping = "0.5 ms"},
  rubber = {young = 2e5, density = 900, damping = "0.5 ms", poisson = 0.4}}})
s.save("bar.glb", s.simplify(s.lattice(grid), {levels = 1, seed = 1}))
)";

void make_asset(const TemporaryFolder& folder) {
  spit(folder / "bar.obj", springlod::test::obj_of_boxes({{"rod", 0, 2}, {"rubber", 2, 3}}));
  spit(folder / "make.lua", kMakeAsset);
  const Ran ran = springlod_run({"run", "make.lua"}, "", folder.path());
  INFO(ran.err);
  REQUIRE(ran.exit_code == 0);
}

Ran export_to(const TemporaryFolder& folder, const std::string& format, int level) {
  return springlod_run({"export", "bar.glb", "--to", format, "--level", std::to_string(level),
                        "--out", fmt::format("bar{}", level)},
                       "", folder.path());
}

}  // namespace

TEST_CASE("other programs read the positions, masses and stiffnesses of an export", "[long]") {
  // Debian's, for which Debian's packages are.
  const std::filesystem::path python = "/usr/bin/python3";
  if (!std::filesystem::exists(python)) {
    WARN("not run: python3 is not installed (./dev setup test peers)");
    return;
  }
  const TemporaryFolder folder;
  make_asset(folder);
  for (const int level : {0, 1}) {
    for (const char* format : {"json", "npz", "vtk", "msh", "sofa", "usda", "obj"}) {
      const Ran ran = export_to(folder, format, level);
      INFO(format << ": " << ran.err);
      REQUIRE(ran.exit_code == 0);
      // The files of NumPy and of Newton have one name: read the first before the second is
      // written.
      CHECK((ran.out.find("tetrahedra: only the base") != std::string::npos) ==
            (level == 1 && std::string(format) != "usda" && std::string(format) != "obj"));
    }
    const auto read_back = [&](const std::string& kind) {
      constexpr int kMissing = 77;
      const std::string script = source_folder() / "tests/peers/exports/read_back.py";
      const auto read = run_program("/bin/sh",
                                    {"-c", "\"$1\" \"$2\" \"$3\" \"$4\" >&2", "sh", python, script,
                                     kind, fmt::format("bar{}", level)},
                                    folder.path());
      if (read.exit_code == kMissing) {
        WARN("not run: " << read.errors << " (./dev setup peers)");
        return;
      }
      INFO(kind << " of level " << level << ": " << read.errors);
      CHECK(read.exit_code == 0);
    };
    for (const char* kind : {"npz", "vtk", "msh", "gmsh", "sofa", "usda", "obj"}) read_back(kind);
    REQUIRE(export_to(folder, "newton", level).exit_code == 0);
    read_back("newton");
  }
}

TEST_CASE("export prints the settings that keep a body stable, and what is lost") {
  const TemporaryFolder folder;
  make_asset(folder);
  const Ran ran = export_to(folder, "sofa", 0);
  CHECK_THAT(ran.out, Contains("step: at most "));
  CHECK_THAT(ran.out, Contains("not in the file: 8 dilatation terms"));
  CHECK_THAT(ran.err, Contains("wrote bar0.scn, bar0-tetrahedra.scn"));
}

TEST_CASE("export names files for Newton so that Python can import them") {
  const TemporaryFolder folder;
  make_asset(folder);
  std::filesystem::rename(folder / "bar.glb", folder / "a-bar.glb");
  const Ran ran = springlod_run({"export", "a-bar.glb", "--to", "newton"}, "", folder.path());
  CHECK_THAT(ran.err, Contains("wrote a_bar_level0_newton.npz, a_bar_level0_newton.py"));
  const Ran named =
      springlod_run({"export", "a-bar.glb", "--to", "newton", "-o", "it.py"}, "", folder.path());
  CHECK_THAT(named.err, Contains("wrote it.npz, it.py"));
}

TEST_CASE("export refuses a level that the asset does not have, and an unknown format") {
  const TemporaryFolder folder;
  make_asset(folder);
  const Ran level = export_to(folder, "vtk", 7);
  CHECK(level.exit_code != 0);
  CHECK_THAT(level.err, Contains("cannot export bar.glb"));
  CHECK_FALSE(std::filesystem::exists(folder / "bar7.vtu"));
  const Ran format = export_to(folder, "vrml", 0);
  CHECK(format.exit_code == 2);
  CHECK_THAT(format.err, Contains("newton"));
}
