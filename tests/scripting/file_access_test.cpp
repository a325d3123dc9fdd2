// The files that a script may use.

#include "scripting/engine/file_access.hpp"

#include <filesystem>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace springlod::scripting {
namespace {

namespace fs = std::filesystem;

TEST_CASE("without restrictions, all files are allowed") {
  FileAccess files;
  CHECK(files.may_read("/etc/passwd"));
  CHECK(files.may_write("/etc/passwd"));
}

TEST_CASE("of a project, all is allowed but hidden files") {
  const test::TemporaryFolder scratch;
  const fs::path project = scratch / "project";
  fs::create_directories(project / "meshes");
  FileAccess files;
  files.restrict();
  files.allow_project(project);

  CHECK(files.may_write(project));
  CHECK(files.may_write(project / "meshes/ball.obj"));
  CHECK(files.may_read(project / "meshes/ball.obj"));
  CHECK(files.may_write(project / "new/folder/file"));
  CHECK(files.may_write(project / "meshes/../x"));
  CHECK_FALSE(files.may_read(project / "../x"));
  CHECK_FALSE(files.may_write(project / "new/../../x"));
  CHECK_FALSE(files.may_read(scratch / "project2"));
  CHECK_FALSE(files.may_read(project / ".git/hooks/post-commit"));
  CHECK_FALSE(files.may_write(project / "meshes/.hidden"));
  CHECK_THROWS_WITH(files.require_writable("/etc/passwd"),
                    Catch::Contains("/etc/passwd") && Catch::Contains("--unsafe"));
  CHECK_THROWS_AS(files.require_readable("/etc/passwd"), InputError);
}

TEST_CASE("a project in a hidden folder is a project") {
  const test::TemporaryFolder scratch;
  FileAccess files;
  files.restrict();
  files.allow_project(scratch / ".cache/project");
  CHECK(files.may_write(scratch / ".cache/project/file"));
  CHECK_FALSE(files.may_write(scratch / ".cache/file"));
}

TEST_CASE("links do not lead out of a project") {
  const test::TemporaryFolder scratch;
  fs::create_directories(scratch / "project");
  fs::create_directories(scratch / "secret");
  fs::create_directory_symlink(scratch / "secret", scratch / "project/link");
  fs::create_directory_symlink(scratch / "project", scratch / "entry");
  FileAccess files;
  files.restrict();
  files.allow_project(scratch / "entry");
  CHECK_FALSE(files.may_read(scratch / "project/link/key"));
  CHECK_FALSE(files.may_write(scratch / "project/link"));
  CHECK(files.may_read(scratch / "project/file"));
}

TEST_CASE("a named file is allowed with what has its stem beside it") {
  const test::TemporaryFolder scratch;
  FileAccess files;
  files.restrict();
  files.allow_named(scratch / "ball.glb");
  CHECK(files.may_write(scratch / "ball.glb"));
  CHECK(files.may_write(scratch / "ball.calibration/.level-1.7.bin"));
  CHECK(files.may_write(scratch / "ball-2.glb"));
  CHECK_FALSE(files.may_write(scratch / "ball"));
  CHECK_FALSE(files.may_write(scratch / "balloon.glb"));
  CHECK_FALSE(files.may_read(scratch / "other.glb"));
  CHECK_FALSE(files.may_read(scratch.path()));
}

TEST_CASE("an empty name allows nothing") {
  FileAccess files;
  files.restrict();
  files.allow_named("");
  CHECK_FALSE(files.may_read("/etc/passwd"));
  CHECK_FALSE(files.may_read(""));
}

TEST_CASE("a named folder is allowed with all below it") {
  const test::TemporaryFolder scratch;
  fs::create_directories(scratch / "out");
  FileAccess files;
  files.restrict();
  files.allow_named((scratch / "out").string() + "/");
  CHECK(files.may_write(scratch / "out/a/b"));
  CHECK_FALSE(files.may_write(scratch / "out.txt"));
}

TEST_CASE("a folder for reading is not for writing, and its links are followed for modules alone") {
  const test::TemporaryFolder scratch;
  fs::create_directories(scratch / "modules");
  fs::create_directories(scratch / "older");
  test::spit(scratch / "older/parse.lua", "return 1");
  fs::create_symlink(scratch / "older/parse.lua", scratch / "modules/parse.lua");

  FileAccess reading;
  reading.restrict();
  reading.allow_reading(scratch / "modules");
  CHECK(reading.may_read(scratch / "modules/other.lua"));
  CHECK_FALSE(reading.may_write(scratch / "modules/other.lua"));
  CHECK_FALSE(reading.may_read(scratch / "modules/parse.lua"));

  FileAccess modules;
  modules.restrict();
  modules.allow_modules((scratch / "modules").string() + "/");
  CHECK(modules.may_read(scratch / "modules/parse.lua"));
  CHECK_FALSE(modules.may_write(scratch / "modules/parse.lua"));
  CHECK_FALSE(modules.may_read(scratch / "older/parse.lua"));
  CHECK_FALSE(modules.may_read(scratch / "modules/../older/parse.lua"));
}

}  // namespace
}  // namespace springlod::scripting
