#include "base/file.hpp"

#include <array>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/descriptor.hpp"
#include "base/error.hpp"
#include "base/temporary_file.hpp"
#include "tests/support/assets.hpp"
#include "tests/support/temporary_folder.hpp"

namespace springlod {
namespace {

using Catch::Matchers::Contains;
using test::TemporaryFolder;
namespace fs = std::filesystem;

std::ptrdiff_t files_in(const fs::path& folder) {
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
                                [](const fs::path& aside) {
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
  write_aside(folder / "a.glb", [&](const fs::path& aside) {
    CHECK(aside.extension() == ".glb");
    CHECK(aside.parent_path() == folder.path());
    std::ofstream(aside) << "new";
    CHECK(read_file(folder / "a.glb") == "old");
  });
  CHECK(read_file(folder / "a.glb") == "new");
}

TEST_CASE("Links are followed: the file behind them is replaced, or made") {
  const TemporaryFolder folder;
  write_text_file(folder / "data/file.txt", "old");
  fs::create_symlink("data/file.txt", folder / "link.txt");
  fs::create_symlink("link.txt", folder / "second.txt");
  write_text_file(folder / "second.txt", "new");
  CHECK(fs::is_symlink(folder / "second.txt"));
  CHECK(fs::is_symlink(folder / "link.txt"));
  CHECK(read_file(folder / "data/file.txt") == "new");

  fs::create_symlink("data/later/none.txt", folder / "dangling.txt");
  write_text_file(folder / "dangling.txt", "made");
  CHECK(read_file(folder / "data/later/none.txt") == "made");

  fs::create_symlink("circle.txt", folder / "circle.txt");
  CHECK_THROWS_WITH(write_text_file(folder / "circle.txt", "x"), Contains("circle.txt"));
}

TEST_CASE("A pipe is written to, and not replaced by a file") {
  const TemporaryFolder folder;
  REQUIRE(mkfifo((folder / "pipe.txt").c_str(), 0600) == 0);
  const Descriptor reading(open((folder / "pipe.txt").c_str(), O_RDONLY | O_NONBLOCK));
  write_text_file(folder / "pipe.txt", "through");
  std::array<char, 20> bytes{};
  CHECK(read(reading.number(), bytes.data(), bytes.size()) == 7);
  CHECK(std::string(bytes.data()) == "through");
  CHECK(fs::is_fifo(folder / "pipe.txt"));
}

// A process that stays until it is killed, with a temporary file in the folder.
pid_t process_that_writes_in(const fs::path& folder) {
  const Pipe ready = make_pipe();
  const pid_t process = fork();
  if (process == 0) {
    const TemporaryFile file(folder, ".txt");
    const bool sent = write(ready.writing.number(), "r", 1) == 1;
    while (sent) pause();
    _exit(1);
  }
  char byte = 0;
  REQUIRE(read(ready.reading.number(), &byte, 1) == 1);
  return process;
}

TEST_CASE("The temporary file of a killed process is removed, that of a living one is not") {
  const TemporaryFolder folder;
  const pid_t process = process_that_writes_in(folder.path());
  write_text_file(folder / ".springlod-notes.txt", "of the user");
  write_text_file(folder / "file.txt", "new");
  CHECK(files_in(folder.path()) == 3);
  kill(process, SIGKILL);
  waitpid(process, nullptr, 0);
  CHECK(files_in(folder.path()) == 3);
  write_aside(
      folder / "a.png", [](const fs::path& aside) { std::ofstream(aside) << "unsynced"; },
      Durability::unsynced);
  CHECK(files_in(folder.path()) == 4);  // without a look at the folder
  write_text_file(folder / "file.txt", "newer");
  CHECK(files_in(folder.path()) == 3);
  CHECK(read_file(folder / ".springlod-notes.txt") == "of the user");
}

TEST_CASE("Several threads write to one folder", "[threaded]") {
  const TemporaryFolder folder;
  std::vector<std::thread> threads;
  for (const char* name : {"a", "b", "c", "d"})
    threads.emplace_back([path = folder / name] {
      for (int i = 0; i <= 20; ++i) write_text_file(path, std::to_string(i));
    });
  for (std::thread& thread : threads) thread.join();
  for (const char* name : {"a", "b", "c", "d"}) CHECK(read_file(folder / name) == "20");
  CHECK(files_in(folder.path()) == 4);
}

TEST_CASE("An unreadable or unwritable path is reported with the reason") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(read_file(folder / "missing"), Contains("missing") && Contains("No such file"));
  CHECK_THROWS_WITH(read_file(folder.path()), Contains("is a folder"));
  write_text_file(folder / "file", "text");
  CHECK_THROWS_AS(write_text_file(folder / "file/below.txt", "x"), IoError);
  CHECK_THROWS_AS(write_text_file(folder.path(), "x"), IoError);
  CHECK_THROWS_WITH(write_text_file(folder.path(), "x"), Contains("is a folder"));
}

TEST_CASE("The content hash is xxh3-64 in 16 digits") {
  CHECK(content_hash("") == "2d06800538d394c2");  // known value of the empty input
  CHECK(content_hash("a") != content_hash("b"));
  CHECK(content_hash(std::string(1000, 'x')).size() == 16);
}

}  // namespace
}  // namespace springlod
