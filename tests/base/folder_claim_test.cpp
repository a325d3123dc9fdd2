#include "base/folder_claim.hpp"

#include <csignal>
#include <optional>

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.hpp"
#include "base/file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace springlod {
namespace {

using Catch::Matchers::Contains;
using test::TemporaryFolder;
namespace fs = std::filesystem;

TEST_CASE("A folder is in use as long as its claim lives") {
  const TemporaryFolder scratch;
  const fs::path folder = scratch / "new/out";
  std::optional<FolderClaim> claim(std::in_place, folder, "compare");
  CHECK_FALSE(claim->continues());
  const std::string process = "springlod compare (process " + std::to_string(getpid()) + ")";
  CHECK_THROWS_WITH(FolderClaim(folder, "compare"), Contains(folder.string()) && Contains(process));
  CHECK_THROWS_AS(FolderClaim(folder, "stability"), InputError);
  write_text_file(folder / "table.csv", "x");
  claim.reset();
  CHECK(FolderClaim(folder, "compare").continues());
}

TEST_CASE("A finished run is not continued") {
  const TemporaryFolder scratch;
  {
    FolderClaim claim(scratch.path(), "compare");
    write_text_file(scratch / "table.csv", "x");
    claim.finish();
  }
  CHECK_FALSE(FolderClaim(scratch.path(), "compare").continues());
}

TEST_CASE("A folder of another command is refused, and stays as it is") {
  const TemporaryFolder scratch;
  {
    FolderClaim claim(scratch.path(), "stability");
    write_text_file(scratch / "map.csv", "x");
    CHECK_THROWS(FolderClaim(scratch.path(), "compare"));
    claim.finish();
  }
  CHECK_THROWS_WITH(FolderClaim(scratch.path(), "compare"),
                    Contains("holds the results of springlod stability"));
  CHECK_FALSE(FolderClaim(scratch.path(), "stability").continues());
  CHECK_THROWS_WITH(FolderClaim(scratch.path(), "compare"),
                    Contains("holds an unfinished run of springlod stability"));
  fs::remove(scratch / "map.csv");
  CHECK_FALSE(FolderClaim(scratch.path(), "compare").continues());  // nothing would be mixed
}

TEST_CASE("What wrote nothing leaves nothing") {
  const TemporaryFolder scratch;
  { const FolderClaim claim(scratch / "new", "compare"); }
  CHECK_FALSE(fs::exists(scratch / "new"));
  fs::create_directory(scratch / "old");
  { const FolderClaim claim(scratch / "old", "compare"); }
  CHECK(fs::is_empty(scratch / "old"));
}

TEST_CASE("A killed process leaves its folder unfinished and free") {
  const TemporaryFolder scratch;
  const pid_t process = fork();
  if (process == 0) {
    const FolderClaim claim(scratch.path(), "compare");
    write_text_file(scratch / "table.csv", "x");
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  waitpid(process, &status, 0);
  REQUIRE(WIFSIGNALED(status));
  CHECK(FolderClaim(scratch.path(), "compare").continues());
}

TEST_CASE("A path that is no folder is named") {
  const TemporaryFolder scratch;
  write_text_file(scratch / "file", "x");
  CHECK_THROWS_WITH(FolderClaim(scratch / "file", "compare"), Contains("cannot make the folder"));
  CHECK_THROWS_AS(FolderClaim(scratch / "file/below", "compare"), IoError);
}

}  // namespace
}  // namespace springlod
