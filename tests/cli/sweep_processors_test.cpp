// Sweeps on processors of different kinds.

#include <cstdlib>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/cli/csv_rows.hpp"
#include "tests/cli/sweep_scratch.hpp"

using Catch::Matchers::Contains;
using springlod::test::rows_of;
using springlod::test::slurp;
using springlod::test::spit;
using springlod::test::SweepScratch;

namespace fs = std::filesystem;

TEST_CASE("Units of a plan made with --portable run with it") {
  const SweepScratch scratch(R"(
local s = require "springlod"
return s.sweep{count = 3, columns = {"portable"},
  unit = function() return {portable = s.portable} end})");
  scratch.must({"plan", "walk.lua", "--out", "out", "--portable"});
  scratch.must({"run", "out"});
  for (const auto& row : rows_of(scratch.merged())) CHECK(row.at("portable") == "true");
  for (const auto& row : rows_of(slurp(scratch / "out/runs.csv"))) {
    CHECK(row.at("blas") == "Nehalem");
    CHECK(row.at("target") == "SSE4");
  }
  CHECK_THAT(scratch.run({"plan", "walk.lua", "--out", "out"}).err,
             Contains("holds results of a plan with --portable"));
  scratch.plan("usual");
  CHECK_THAT(scratch.run({"run", "usual", "--portable"}).err,
             Contains("the plan was made without --portable"));
  scratch.must({"run", "usual"});
  CHECK(rows_of(scratch.merged("usual")).at(0).at("portable") == "false");
  for (const auto& row : rows_of(slurp(scratch / "usual/runs.csv"))) {
    CAPTURE(row.at("target"), row.at("blas"));
    CHECK((row.at("target").substr(0, 3) != "AVX" || row.at("blas") == "Haswell"));
  }
}

TEST_CASE("Merging names units that ran on different processors") {
  const SweepScratch scratch(R"(
local s = require "springlod"
return s.sweep{count = 4, columns = {"n"}, unit = function(point) return {n = point.index} end})");
  scratch.plan();
  setenv("OPENBLAS_CORETYPE", "Nehalem", 1);
  scratch.must({"run", "out"});
  CHECK_THAT(scratch.must({"merge", "out"}), !Contains("different processors"));
  for (const char* unit : {"0000000", "0000002", "0000003"})
    fs::remove(scratch / "out/results/0000" / (std::string(unit) + ".json"));
  setenv("OPENBLAS_CORETYPE", "Prescott", 1);
  scratch.must({"run", "out"});
  unsetenv("OPENBLAS_CORETYPE");
  CHECK_THAT(scratch.must({"merge", "out"}), Contains("(Nehalem: 1, Prescott: 3)") &&
                                                 Contains("plan with --portable") &&
                                                 !Contains("round differently"));
  // As if a unit had run on a processor of the other kind.
  const fs::path result = scratch / "out/results/0000/0000001.json";
  std::string text = slurp(result);
  const std::string key = "\"target\":\"";
  const std::size_t begin = text.find(key) + key.size();
  REQUIRE(begin > key.size());
  const bool is_new = text.compare(begin, 3, "AVX") == 0;
  text.replace(begin, text.find('"', begin) - begin, is_new ? "SSE4" : "AVX2");
  spit(result, text);
  CHECK_THAT(scratch.must({"merge", "out"}),
             Contains(is_new ? "round differently (AVX2 or newer: 3, older: 1)"
                             : "round differently (AVX2 or newer: 1, older: 3)"));
}
