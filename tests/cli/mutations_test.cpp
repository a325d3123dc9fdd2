#include <filesystem>

#include <catch2/catch.hpp>

#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::test::obj_of_boxes;
using springlod::test::Ran;
using springlod::test::spit;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace {

const char* const kPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
const char* const kOff =
    "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
const char* const kStl =
    "solid tip\n"
    "facet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\n"
    "facet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n"
    "facet normal 1 1 1\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\n"
    "facet normal -1 0 0\nouter loop\nvertex 0 1 0\nvertex 0 0 0\nvertex 0 0 1\nendloop\nendfacet\n"
    "endsolid tip\n";

}  // namespace

TEST_CASE("Damaged meshes are imported or refused, none crashes the program") {
  const TemporaryFolder scratch;
  spit(scratch / "box.obj", obj_of_boxes({{"box", 0, 1}}));
  spit(scratch / "tip.ply", kPly);
  spit(scratch / "tip.off", kOff);
  spit(scratch / "tip.stl", kStl);
  const auto script = springlod::test::source_folder() / "tests/mutations/meshes.lua";
  const Ran ran = springlod_run({"-q", "run", script.string(), "--", "80",
                                 (scratch / "box.obj").string(), (scratch / "tip.ply").string(),
                                 (scratch / "tip.off").string(), (scratch / "tip.stl").string()});
  CAPTURE(ran.out, ran.err);
  CHECK(ran.exit_code == 0);
  for (const char* format : {".obj", ".ply", ".off", ".stl"}) CHECK_THAT(ran.out, Contains(format));
}

TEST_CASE("Damaged assets and .vdb files are read or refused, none crashes the program") {
  const TemporaryFolder scratch;
  const auto source = springlod::test::source_folder() / "tests";
  const Ran made = springlod_run(
      {"-q", "run", (source / "fuzz/make_corpus.lua").string(), "--", scratch.path().string()});
  CAPTURE(made.err);
  REQUIRE(made.exit_code == 0);
  const auto mutants = [&](const char* script, const char* count, const std::string& file) {
    const Ran ran = springlod_run({"-q", "run", (source / "mutations" / script).string(), "--",
                                   count, (scratch / file).string()});
    CAPTURE(ran.out, ran.err);
    CHECK(ran.exit_code == 0);
    for (const char* half : {"as damaged", "valid"}) CHECK_THAT(ran.out, Contains(half));
  };
  mutants("assets.lua", "100", "asset/two_materials.glb");
  mutants("assets.lua", "40", "asset/certified.glb");
  // Not those on which OpenVDB asks for all memory, which sanitizers do not limit.
  mutants("vdb.lua", "3-7", "vdb/two_materials.vdb");
}

TEST_CASE("Meshes with removed faces have the volume of the whole ones", "[long]") {
  const auto script = springlod::test::source_folder() / "tests/mutations/holes.lua";
  const Ran ran = springlod_run({"-q", "run", script.string(), "--", "1", "samples/dumbbell.obj"});
  CAPTURE(ran.out, ran.err);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("hollow torus") && Contains("hollow cube"));
}

TEST_CASE("Meshes are converted and drawn, and a sheet does not count") {
  const TemporaryFolder scratch;
  spit(scratch / "box.obj", obj_of_boxes({{"box", 0, 1}}));
  spit(scratch / "sheet.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0.1\nf 1 2 3\n");
  spit(scratch / "notes.txt", "not a mesh");
  const auto script = springlod::test::source_folder() / "tests/mutations/models.lua";
  const Ran ran = springlod_run({"-q", "run", script.string(), "--", (scratch / "out").string(),
                                 (scratch / "box.obj").string(), (scratch / "sheet.obj").string(),
                                 (scratch / "notes.txt").string()});
  CAPTURE(ran.out, ran.err);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("bounds nothing") &&
                          Contains("1 of 1 meshes that bound anything were converted"));
  CHECK(std::filesystem::exists(scratch / "out/001.png"));
}
