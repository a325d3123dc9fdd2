#include "base/file.hpp"

#include <fstream>
#include <iterator>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "tests/support/assets.hpp"
#include "tests/support/temporary_folder.hpp"

namespace springlod {
namespace {

using Catch::Matchers::Contains;
using test::TemporaryFolder;

std::ptrdiff_t files_in(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), {});
}

TEST_CASE("write_text_file makes missing folders, and read_file returns the text") {
  const TemporaryFolder folder;
  const std::string text("line\n\0\r\n\xFF", 9);
  write_text_file(folder / "new/deep/file.txt", text);
  CHECK(read_file(folder / "new/deep/file.txt") == text);
  write_text_file(folder / "new/deep/file.txt", "");
  CHECK(read_file(folder / "new/deep/file.txt").empty());
  CHECK(files_in(folder / "new/deep") == 1);
}

TEST_CASE("After a failed writer the old file is unchanged and no temporary file is left") {
  const TemporaryFolder folder;
  write_text_file(folder / "file.txt", "old");
  CHECK_THROWS_WITH(write_aside(folder / "file.txt",
                                [](const std::filesystem::path& aside) {
                                  std::ofstream(aside) << "half of the n";
                                  throw std::runtime_error("power cut");
                                }),
                    "power cut");
  CHECK(read_file(folder / "file.txt") == "old");
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE(
    "The temporary file has the extension of the old one, which stays until the new one is "
    "complete") {
  const TemporaryFolder folder;
  write_text_file(folder / "a.glb", "old");
  write_aside(folder / "a.glb", [&](const std::filesystem::path& aside) {
    CHECK(aside.extension() == ".glb");
    CHECK(aside.parent_path() == folder.path());
    std::ofstream(aside) << "new";
    CHECK(read_file(folder / "a.glb") == "old");
  });
  CHECK(read_file(folder / "a.glb") == "new");
}

TEST_CASE("An unreadable or unwritable path is reported with the reason") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(read_file(folder / "missing"), Contains("missing") && Contains("No such file"));
  CHECK_THROWS_WITH(read_file(folder.path()), Contains("is a folder"));
  write_text_file(folder / "file", "text");
  CHECK_THROWS_AS(write_text_file(folder / "file/below.txt", "x"), IoError);
  CHECK_THROWS_AS(write_text_file(folder.path(), "x"), IoError);
  // If the writer writes nothing, there is no file to rename.
  CHECK_THROWS_WITH(write_aside(folder / "none.txt", [](const auto&) {}), Contains("none.txt"));
}

TEST_CASE("The content hash is xxh3-64 in 16 digits") {
  CHECK(content_hash("") == "2d06800538d394c2");  // known value of the empty input
  CHECK(content_hash("a") != content_hash("b"));
  CHECK(content_hash(std::string(1000, 'x')).size() == 16);
}

}  // namespace
}  // namespace springlod
