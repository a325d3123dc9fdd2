#include "base/child_work.hpp"

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include <catch2/catch.hpp>
#include <unistd.h>

#include "tests/support/sanitized.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace springlod;
using Catch::Matchers::Contains;
using Catch::Matchers::Equals;

namespace {

[[noreturn]] void spin() {
  const volatile bool forever = true;
  while (forever) {
  }
  std::abort();
}

/// Asks to stop as soon as it is asked.
class Stop : public Progress {
 public:
  void advance(std::uint64_t /*count*/) override { throw InterruptedError(); }
};

}  // namespace

TEST_CASE("A child process returns any bytes, and changes nothing here") {
  int here = 1;
  const std::string bytes = run_in_child(
      [&] {
        here = 2;
        return std::string("a\0b", 3);
      },
      {});
  CHECK(bytes == std::string("a\0b", 3));
  CHECK(here == 1);
  CHECK(run_in_child([] { return std::string(); }, {}).empty());
  const std::string large(50'000'000, 'x');  // much more than a pipe holds
  CHECK(run_in_child([&] { return large; }, {}) == large);
}

TEST_CASE("Errors in a child process are thrown here, by their kind") {
  const auto fails = [](auto error) { return [error]() -> std::string { throw error; }; };
  CHECK_THROWS_AS(run_in_child(fails(InputError("no mass")), {}), InputError);
  CHECK_THROWS_WITH(run_in_child(fails(InputError("no mass")), {}), Equals("no mass"));
  CHECK_THROWS_AS(run_in_child(fails(IoError("no file")), {}), IoError);
  CHECK_THROWS_WITH(run_in_child(fails(IoError("no file")), {}), Equals("no file"));
  CHECK_THROWS_AS(run_in_child(fails(std::runtime_error("odd")), {}), ChildFailure);
  CHECK_THROWS_WITH(run_in_child(fails(std::runtime_error("odd")), {}), Equals("failed (odd)"));
  CHECK_THROWS_AS(run_in_child(fails(1), {}), ChildFailure);
  try {
    run_in_child(fails(IoError(std::string(1'000'000, 'x'))), {});
    FAIL("no error");
  } catch (const IoError& error) {
    CHECK(std::string(error.what()).size() == 2000);
  }
}

TEST_CASE("A crash in a child process is an error that says how it crashed") {
  const auto by = [](int signal) {
    return [signal]() -> std::string {
      std::signal(signal, SIG_DFL);
      std::raise(signal);
      return "not reached";
    };
  };
  CHECK_THROWS_WITH(run_in_child(by(SIGSEGV), {}), Equals("crashed (Segmentation fault)"));
  CHECK_THROWS_WITH(run_in_child(by(SIGABRT), {}), Equals("crashed (Aborted)"));
  CHECK_THROWS_AS(run_in_child(by(SIGKILL), {}), ChildFailure);
  CHECK_THROWS_WITH(run_in_child([]() -> std::string { _exit(0); }, {}),
                    Equals("ended without a result"));
}

TEST_CASE("A child process is stopped at its limits") {
  ChildLimits limits;
  SECTION("of processor time") {
    limits.seconds = 1;
    CHECK_THROWS_WITH(run_in_child([]() -> std::string { spin(); }, limits),
                      Equals("took longer than 1 s"));
  }
  SECTION("of time by the clock") {
    limits.seconds = 0.1;
    CHECK_THROWS_WITH(run_in_child([]() -> std::string { return ::pause(), ""; }, limits),
                      Equals("took longer than 0.1 s"));
  }
  SECTION("of memory") {
    if (springlod::test::kSanitized) return;
    limits.memory = std::uint64_t{1} << 28U;
    CHECK_THROWS_WITH(run_in_child([] { return std::string(std::size_t{1} << 29U, 'x'); }, limits),
                      Equals("needed more than 0.25 GB of memory"));
  }
  SECTION("of its result") {
    limits.result = 1000;
    CHECK_THROWS_WITH(run_in_child([] { return std::string(100'000, 'x'); }, limits),
                      Contains("too large"));
  }
}

TEST_CASE("A child process can be interrupted, and writes no file") {
  Stop stop;
  CHECK_THROWS_AS(run_in_child([]() -> std::string { spin(); }, {}, &stop), InterruptedError);
  const test::TemporaryFolder folder;
  const std::string path = (folder / "file").string();
  const auto write = [&] {
    std::signal(SIGXFSZ, SIG_IGN);
    std::ofstream(path) << "text";
    return std::string();
  };
  run_in_child(write, {});
  CHECK(std::ifstream(path).peek() == std::ifstream::traits_type::eof());
}
