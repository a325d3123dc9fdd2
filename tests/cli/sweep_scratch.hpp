#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

namespace springlod::test {

/// A folder with the script of a sweep, walk.lua, in which the program is run.
class SweepScratch {
 public:
  explicit SweepScratch(const std::string& script) { spit(folder_ / "walk.lua", script); }
  Ran run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "sweep");
    return springlod_run(arguments, "", folder_.path());
  }
  /// Runs and returns what is printed.
  std::string must(const std::vector<std::string>& arguments) const {
    const Ran ran = run(arguments);
    CAPTURE(arguments, ran.err, ran.out);
    REQUIRE(ran.exit_code == 0);
    return ran.out + ran.err;
  }
  void plan(const std::string& out = "out") const { must({"plan", "walk.lua", "--out", out}); }
  std::string merged(const std::string& out = "out") const {
    must({"merge", out});
    return slurp(folder_ / out / "results.csv");
  }
  std::filesystem::path operator/(const std::filesystem::path& name) const {
    return folder_ / name;
  }
  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

}  // namespace springlod::test
