#include "voxelize/mesh/import.hpp"

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "tests/support/temporary_folder.hpp"
#include "voxelize/mesh/solid.hpp"

namespace springlod::voxelize {

using Catch::Matchers::Contains;
using springlod::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

fs::path write(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
  write_text_file(folder / name, text);
  return folder / name;
}

// A box 1 x 2 x 3 of two materials, and a tetrahedron; z up.
const std::string kBoxObj = R"(mtllib box.mtl
o box
v 0 0 0
v 1 0 0
v 1 2 0
v 0 2 0
v 0 0 3
v 1 0 3
v 1 2 3
v 0 2 3
usemtl red
f 1 4 3 2
f 1 2 6 5
f 2 3 7 6
usemtl blue
f 5 6 7 8
f 3 4 8 7
f 4 1 5 8
o tip
v 5 0 0
v 6 0 0
v 5 1 0
v 5 0 1
f 9 11 10
f 9 10 12
f 10 11 12
f 11 9 12
)";
const std::string kBoxMtl = "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n";

fs::path write_box(const TemporaryFolder& folder) {
  write(folder, "box.mtl", kBoxMtl);
  return write(folder, "box.obj", kBoxObj);
}

// The box of write_box in another format, through assimp's exporter.
fs::path export_box(const TemporaryFolder& folder, const std::string& format,
                    const std::string& name) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(write_box(folder).string(), aiProcess_Triangulate);
  REQUIRE(scene != nullptr);
  Assimp::Exporter exporter;
  REQUIRE(exporter.Export(scene, format, (folder / name).string()) == aiReturn_SUCCESS);
  return folder / name;
}

double total_volume(const TriangleMesh& mesh) {
  double volume = 0;
  for (const SolidReport& solid : check_solid(mesh)) {
    CHECK(solid.closed());
    volume += solid.volume;
  }
  return volume;
}

void replace(std::string& text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != text.npos);
  text.replace(at, from.size(), to);
}

const double kBoxVolume = 6 + 1.0 / 6;

}  // namespace

TEST_CASE("The parts of an OBJ file keep their names and materials") {
  const TemporaryFolder folder;
  const ImportedMesh imported = import_mesh(write_box(folder));
  const auto& parts = imported.mesh.parts;
  REQUIRE(parts.size() == 3);
  CHECK(parts[0].name == "box");
  CHECK(parts[0].material == "red");
  CHECK(parts[0].triangle_count == 6);
  CHECK(parts[1].name == "box");
  CHECK(parts[1].material == "blue");
  CHECK(parts[2].name == "tip");
  CHECK(imported.mesh.positions.size() == 12);
  CHECK(check_solid(imported.mesh).size() == 2);
  CHECK(total_volume(imported.mesh) == Approx(kBoxVolume));
  CHECK(bounds(imported.mesh).max() == Vec3(6, 2, 3));
  CHECK(imported.report.format == "OBJ");
  CHECK(imported.report.unit_assumed);
  CHECK(imported.report.up_assumed);
  CHECK(imported.report.content_hash == content_hash(kBoxObj));
}

TEST_CASE("Every format gives the same box, in metres and z up") {
  const TemporaryFolder folder;
  const Vec3 z_up(6, 2, 3);
  const Vec3 y_up(6, 0, 2);  // y became z, z became -y
  struct Case {
    std::string format, file, name;
    double unit;
    bool unit_assumed, up_assumed;
    Vec3 high;
    std::size_t parts;
  };
  const std::vector<Case> cases{
      {"obj", "out.obj", "OBJ", 1, true, true, z_up, 3},
      {"stl", "out.stl", "STL", 1, true, true, z_up, 1},
      {"stlb", "binary.stl", "STL", 1, true, true, z_up, 1},
      {"ply", "out.ply", "PLY", 1, true, true, z_up, 1},
      {"plyb", "binary.ply", "PLY", 1, true, true, z_up, 1},
      {"glb2", "out.glb", "glTF", 1, false, false, y_up, 3},
      {"gltf2", "out.gltf", "glTF", 1, false, false, y_up, 3},
      {"collada", "out.dae", "Collada", 1, false, false, y_up, 3},
      {"fbxa", "out.fbx", "FBX", 0.01, false, false, y_up * 0.01, 3},
  };
  for (const Case& c : cases) {
    INFO(c.file);
    const ImportedMesh imported = import_mesh(export_box(folder, c.format, c.file));
    CHECK(imported.report.format == c.name);
    CHECK(imported.report.unit == Approx(c.unit));
    CHECK(imported.report.unit_assumed == c.unit_assumed);
    CHECK(imported.report.up_assumed == c.up_assumed);
    CHECK((bounds(imported.mesh).max() - c.high).norm() < 1e-6 * c.high.norm());
    CHECK(total_volume(imported.mesh) == Approx(kBoxVolume * std::pow(c.unit, 3)));
    CHECK(imported.mesh.parts.size() == c.parts);
    if (c.parts == 3) {
      CHECK(imported.mesh.parts[0].name == "box");
      CHECK(imported.mesh.parts[0].material == "red");
      CHECK(imported.mesh.parts[1].material == "blue");
      CHECK(imported.mesh.parts[2].name == "tip");
    }
  }
}

TEST_CASE("An OFF file is imported, and an unnamed part gets a number") {
  const TemporaryFolder folder;
  const auto path = write(folder, "tip.off",
                          "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                          "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
  const ImportedMesh imported = import_mesh(path);
  CHECK(imported.report.format == "OFF");
  REQUIRE(imported.mesh.parts.size() == 1);
  CHECK(imported.mesh.parts[0].name == "part_1");
  CHECK(imported.mesh.parts[0].material.empty());
  CHECK(total_volume(imported.mesh) == Approx(1.0 / 6));
}

TEST_CASE("The caller's unit and up axis override the file's and are not reported as assumed") {
  const TemporaryFolder folder;
  const ImportedMesh imported = import_mesh(write_box(folder), {.unit = 0.01, .up = UpAxis::y});
  CHECK(imported.report.unit == 0.01);
  CHECK_FALSE(imported.report.unit_assumed);
  CHECK_FALSE(imported.report.up_assumed);
  CHECK(bounds(imported.mesh).min().isApprox(Vec3(0, -0.03, 0)));
  CHECK(bounds(imported.mesh).max().isApprox(Vec3(0.06, 0, 0.02)));
  CHECK(total_volume(imported.mesh) == Approx(kBoxVolume * 1e-6));
  const ImportedMesh x_up = import_mesh(write_box(folder), {.unit = {}, .up = UpAxis::x});
  CHECK(bounds(x_up.mesh).max() == Vec3(0, 0, 6));
  CHECK(total_volume(x_up.mesh) == Approx(kBoxVolume));
  CHECK_THROWS_AS(import_mesh(write_box(folder), {.unit = 0, .up = {}}), InputError);
}

TEST_CASE("Unit and up axis of an FBX file are used") {
  const TemporaryFolder folder;
  std::string text = read_file(export_box(folder, "fbxa", "box.fbx"));
  replace(text, R"("UpAxis", "int", "Integer", "", 1)", R"("UpAxis", "int", "Integer", "", 2)");
  replace(text, R"("UnitScaleFactor", "double", "Number", "", 1)",
          R"("UnitScaleFactor", "double", "Number", "", 2.54)");
  const ImportedMesh imported = import_mesh(write(folder, "inch.fbx", text));
  CHECK(imported.report.unit == Approx(0.0254));
  CHECK(imported.report.up == UpAxis::z);
  CHECK(bounds(imported.mesh).max().isApprox(0.0254 * Vec3(6, 2, 3), 1e-6));
  // The options of the caller take precedence.
  const ImportedMesh forced = import_mesh(folder / "inch.fbx", {.unit = 1, .up = UpAxis::y});
  CHECK(bounds(forced.mesh).max().isApprox(Vec3(6, 0, 2), 1e-6));
}

TEST_CASE("Unit and up axis of a Collada file are used") {
  const TemporaryFolder folder;
  std::string text = read_file(export_box(folder, "collada", "box.dae"));
  replace(text, R"(meter="1")", R"(meter="0.001")");
  replace(text, "Y_UP", "Z_UP");
  const ImportedMesh imported = import_mesh(write(folder, "mm.dae", text));
  CHECK(imported.report.unit == Approx(0.001));
  CHECK(imported.report.up == UpAxis::z);
  CHECK(bounds(imported.mesh).max().isApprox(0.001 * Vec3(6, 2, 3), 1e-6));
  const ImportedMesh forced = import_mesh(folder / "mm.dae", {.unit = 1, .up = {}});
  CHECK(bounds(forced.mesh).max().isApprox(Vec3(6, 2, 3), 1e-6));
}

TEST_CASE("Node transforms are applied, and reflections reverse the winding") {
  const TemporaryFolder folder;
  std::string text = read_file(export_box(folder, "gltf2", "box.gltf"));
  const std::size_t at = text.find("\"name\"", text.find("\"nodes\""));
  REQUIRE(at != text.npos);
  // The first node is the root: scaled by two, reflected in x, moved by 10 along glTF's y.
  text.insert(at, R"("scale": [-2, 2, 2], "translation": [0, 10, 0], )");
  const ImportedMesh imported = import_mesh(write(folder, "mirrored.gltf", text));
  CHECK(total_volume(imported.mesh) == Approx(8 * kBoxVolume));
  CHECK(bounds(imported.mesh).min().isApprox(Vec3(-12, -6, 10), 1e-6));
}

TEST_CASE("Faces with repeated vertices are dropped, and equal positions are merged") {
  const TemporaryFolder folder;
  const auto path = write(folder, "tip.obj",
                          "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv -0 0 0\nv 1 0 0\n"
                          "f 1 3 2\nf 5 6 4\nf 2 3 4\nf 3 1 4\nf 1 5 4\n");
  const ImportedMesh imported = import_mesh(path);
  CHECK(imported.mesh.positions.size() == 4);
  CHECK(imported.mesh.triangles.size() == 4);
  CHECK(imported.mesh.parts[0].name == "part_1");
  CHECK(total_volume(imported.mesh) == Approx(1.0 / 6));
}

TEST_CASE("Vertices without triangles are left out, and reported") {
  const TemporaryFolder folder;
  const auto path = write(folder, "stray.obj",
                          "v 0 0 0\nv 1000 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                          "f 1 4 3\nf 1 3 5\nf 3 4 5\nf 4 1 5\nv 0 -1000 0\n");
  const ImportedMesh imported = import_mesh(path);
  CHECK(imported.mesh.positions.size() == 4);
  CHECK(bounds(imported.mesh).max() == Vec3(1, 1, 1));
  CHECK(total_volume(imported.mesh) == Approx(1.0 / 6));
  // Some readers of assimp leave them out themselves.
  if (imported.report.stray_vertices > 0)
    CHECK_THAT(describe(imported.report), Contains("without triangles left out"));
}

TEST_CASE("A file that is not a mesh is rejected with the list of formats") {
  const TemporaryFolder folder;
  const auto refused = [](const fs::path& path, const std::string& with) {
    INFO(path);
    CHECK_THROWS_AS(import_mesh(path), IoError);
    CHECK_THROWS_WITH(import_mesh(path), Contains(with));
  };
  refused(folder / "nowhere.obj", "nowhere.obj: No such file");
  refused(folder.path(), "is a folder");
  refused(write(folder, "empty.stl", ""), "is empty");
  refused(write(folder, "picture.png", "\x89PNG\r\n\x1a\n1234"), ".obj, .stl, .ply");
  refused(write(folder, "table.3mf", "PK"), ".obj, .stl, .ply");
  const std::string text = "this is a letter, not a mesh\n";
  for (const char* ending : {"obj", "stl", "ply", "glb", "gltf", "fbx", "off", "dae"})
    refused(write(folder, std::string("letter.") + ending, text), "cannot read");
  refused(write(folder, "picture.obj", "\x89PNG\r\n\x1a\n1234"), "cannot read");
  // The reader's reasons end in stops, and name objects that may have no name.
  refused(write(folder, "small.obj", "v 0 0 0\n"),
          "small.obj as a mesh: OBJ-file is too small; check");
}

TEST_CASE("Vertices that are not finite and meshes without faces are rejected") {
  const TemporaryFolder folder;
  const std::string faces = "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  for (const char* bad : {"v 0 0 nan\n", "v 0 inf 0\n"}) {
    const auto path = write(folder, "bad.obj", bad + faces);
    CHECK_THROWS_AS(import_mesh(path), InputError);
    CHECK_THROWS_WITH(import_mesh(path), Contains("not finite"));
  }
  CHECK_THROWS_AS(import_mesh(write(folder, "line.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n")), InputError);
}

TEST_CASE("Damaged files on which assimp crashes or hangs are refused with the reason") {
  const TemporaryFolder folder;
  // assimp looks for the end of the header for ever.
  const std::string header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n";
  for (const std::size_t length : {std::size_t{3}, std::size_t{20}, header.size()}) {
    const fs::path cut = write(folder, "cut.ply", header.substr(0, length));
    CHECK_THROWS_AS(import_mesh(cut), IoError);
    CHECK_THROWS_WITH(import_mesh(cut), Contains("end_header"));
  }
}

TEST_CASE("describe() states the assumptions") {
  const TemporaryFolder folder;
  const std::string assumed = describe(import_mesh(write_box(folder)).report);
  CHECK_THAT(assumed,
             Contains("assumed 1 unit = 1 m (OBJ does not state it; the option unit changes it)"));
  CHECK_THAT(assumed, Contains("assumed z is up"));
  const std::string given =
      describe(import_mesh(write_box(folder), {.unit = 0.001, .up = UpAxis::y}).report);
  CHECK_THAT(given, !Contains("assumed"));
  CHECK_THAT(given, Contains("0.001 m"));
}

}  // namespace springlod::voxelize
