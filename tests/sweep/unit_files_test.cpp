#include "sweep/unit_files.hpp"

#include <array>
#include <chrono>
#include <csignal>
#include <cstring>

#include <catch2/catch.hpp>
#include <sys/inotify.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/descriptor.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace springlod::sweep {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

UnitState state_of(const UnitFiles& files, std::uint64_t unit) {
  return files.notes(unit).state;
}

/// Begins a unit in a process that is then killed.
void lose(const UnitFiles& files, std::uint64_t unit) {
  const pid_t process = fork();
  if (process == 0) {
    files.begin(unit, this_runner("a.log"));
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  waitpid(process, &status, 0);
}

TEST_CASE("A unit is missing, running, done") {
  const TemporaryFolder folder;
  const UnitFiles files(folder.path());
  CHECK(state_of(files, 1234) == UnitState::missing);
  REQUIRE(files.begin(1234, this_runner("a.log")) == 1);
  CHECK(state_of(files, 1234) == UnitState::running);
  files.finish({.unit = 1234, .rows = {{1.5}}});
  CHECK(state_of(files, 1234) == UnitState::done);
  CHECK(files.read_result(1234, 1).rows == std::vector<Row>{{1.5}});
  CHECK_FALSE(fs::exists(files.try_path(1234, 1)));
  CHECK(files.result_path(1234) == folder / "results/0001/0001234.json");
}

TEST_CASE("Of several that begin a unit one succeeds, and nobody begins what is done") {
  const TemporaryFolder folder;
  const UnitFiles files(folder.path());
  REQUIRE(files.begin(0, this_runner("")));
  CHECK_FALSE(files.begin(0, this_runner("")));
  files.finish({.unit = 0});
  CHECK_FALSE(files.begin(0, this_runner("")));
}

TEST_CASE("A unit lost with its process is tried thrice, then it is lost") {
  const TemporaryFolder folder;
  const UnitFiles files(folder.path());
  for (int number = 1; number <= kMostTries; ++number) {
    CHECK(state_of(files, 5) == (number == 1 ? UnitState::missing : UnitState::waiting));
    lose(files, 5);
    CHECK(files.notes(5).tries == number);
    CHECK(files.read_try(5, number)->log == "a.log");
  }
  CHECK(state_of(files, 5) == UnitState::lost);
  CHECK_FALSE(files.begin(5, this_runner("")));
  files.forget(5);
  CHECK(state_of(files, 5) == UnitState::missing);
}

TEST_CASE("A unit that the user stops counts as not run, its earlier tries remain") {
  const TemporaryFolder folder;
  const UnitFiles files(folder.path());
  lose(files, 5);
  REQUIRE(files.begin(5, this_runner("")) == 2);
  files.give_up(5, 2);
  CHECK(state_of(files, 5) == UnitState::waiting);
  CHECK(files.notes(5).tries == 1);
}

TEST_CASE("A unit that failed is not run again") {
  const TemporaryFolder folder;
  const UnitFiles files(folder.path());
  REQUIRE(files.begin(9, this_runner("")));
  files.finish({.unit = 9, .failure = "no"});
  CHECK(state_of(files, 9) == UnitState::failed);
  CHECK_FALSE(files.begin(9, this_runner("")));
  CHECK(files.read_failure(9).failure == "no");
}

TEST_CASE("A process of another machine counts as lost when it is silent") {
  const TemporaryFolder folder;
  const UnitFiles files(folder.path());
  Runner elsewhere = this_runner("");
  elsewhere.system = "another machine, or a container, of the same name";
  REQUIRE(files.begin(3, elsewhere));
  CHECK(state_of(files, 3) == UnitState::running);
  const auto old = fs::file_time_type::clock::now() - std::chrono::seconds(3600);
  fs::last_write_time(files.try_path(3, 1), old);
  CHECK(state_of(files, 3) == UnitState::waiting);
}

TEST_CASE("A process with the number of an earlier one is not that one") {
  const TemporaryFolder folder;
  const UnitFiles files(folder.path());
  Runner earlier = this_runner("");
  --earlier.started;
  REQUIRE(files.begin(3, earlier));
  CHECK(state_of(files, 3) == UnitState::waiting);
}

TEST_CASE("A listing tells the notes of neighbouring units") {
  const TemporaryFolder folder;
  const UnitFiles files(folder.path());
  for (const std::uint64_t unit : {998U, 1001U, 2500U}) files.finish({.unit = unit});
  files.finish({.unit = 999, .failure = "no"});
  lose(files, 1000);
  const std::vector<UnitNotes> notes = files.list(998, 1002);
  REQUIRE(notes.size() == 4);
  CHECK(notes[0].state == UnitState::done);
  CHECK(notes[1].state == UnitState::failed);
  CHECK(notes[2].state == UnitState::waiting);
  CHECK(notes[2].tries == 1);
  CHECK(notes[3].state == UnitState::done);
}

TEST_CASE("A listing looks up the time of the folder at most once") {
  const TemporaryFolder folder;
  const UnitFiles files(folder.path());
  // Each look renames a file to .clock.
  const Descriptor watch(inotify_init1(IN_NONBLOCK));
  REQUIRE(inotify_add_watch(watch.number(), folder.path().c_str(), IN_MOVED_TO) >= 0);
  const auto looks = [&] {
    int count = 0;
    std::array<char, 4096> events{};
    const ssize_t size = read(watch.number(), events.data(), events.size());
    for (ssize_t at = 0; at < size; ++count) {
      inotify_event event{};
      std::memcpy(&event, events.data() + at, sizeof event);
      at += static_cast<ssize_t>(sizeof event + event.len);
    }
    return count;
  };
  REQUIRE(files.begin(7, this_runner("")));
  files.list(0, 8);
  CHECK(looks() == 0);  // a process of this machine
  Runner elsewhere = this_runner("");
  elsewhere.system = "another machine, or a container, of the same name";
  for (const std::uint64_t unit : {0U, 1U, 2U}) REQUIRE(files.begin(unit, elsewhere));
  CHECK(files.list(0, 8)[2].state == UnitState::running);
  CHECK(looks() == 1);
  CHECK(files.list({0, 2})[1].state == UnitState::running);
  CHECK(looks() == 1);
}

TEST_CASE("A try whose file is damaged counts as lost when it is silent") {
  for (const char* text : {"", "{\"host\": 3}", "[1"}) {
    const TemporaryFolder folder;
    const UnitFiles files(folder.path());
    write_text_file(files.try_path(3, 1), text);
    CHECK(state_of(files, 3) == UnitState::running);
    CHECK_FALSE(files.read_try(3, 1));
    const auto old = fs::file_time_type::clock::now() - std::chrono::seconds(3600);
    fs::last_write_time(files.try_path(3, 1), old);
    CHECK(state_of(files, 3) == UnitState::waiting);
  }
}

TEST_CASE("A damaged result is named, with what to do") {
  const TemporaryFolder folder;
  const UnitFiles files(folder.path());
  const std::string good = to_text(UnitResult{.unit = 7, .rows = {{1.5}}});
  const std::string failure = to_text(UnitResult{.unit = 7, .failure = "no"});
  write_text_file(files.result_path(7), good);
  REQUIRE_NOTHROW(files.read_result(7, 1));
  const auto message = Catch::Contains("0000007.json is damaged: remove it");
  CHECK_THROWS_WITH(files.read_result(7, 2), message);
  const std::string other = to_text(UnitResult{.unit = 8, .rows = {{1.5}}});
  for (const std::string& text : {std::string(), good.substr(0, 20), other, failure}) {
    write_text_file(files.result_path(7), text);
    CHECK_THROWS_WITH(files.read_result(7, 1), message);
  }
  write_text_file(files.failure_path(7), good);
  CHECK_THROWS_WITH(files.read_failure(7), Catch::Contains("0000007.failed.json is damaged"));
}

TEST_CASE("A folder that cannot be written to is named") {
  const TemporaryFolder folder;
  write_text_file(folder / "results", "a file where a folder should be");
  const UnitFiles files(folder.path());
  CHECK_THROWS_AS(files.begin(0, this_runner("")), IoError);
}

}  // namespace
}  // namespace springlod::sweep
