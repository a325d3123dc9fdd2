// springlod sweep and s.sweep.

#include <chrono>
#include <csignal>
#include <thread>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/subprocess.hpp"
#include "tests/cli/csv_rows.hpp"
#include "tests/cli/sweep_scratch.hpp"

using Catch::Matchers::Contains;
using springlod::test::Ran;
using springlod::test::rows_of;
using springlod::test::slurp;
using springlod::test::spit;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace fs = std::filesystem;

namespace {

// 12 units; the sum of a random walk, so that a result depends on the seed and on nothing else.
const char* const kWalk = R"(
local s = require "springlod"
return s.sweep{
  axes = {{"steps", {10, 20, 30, 40}}, {"size", {0.1, 0.5, 2.5}}},
  columns = {"place", "word"},
  cost = function(point) return 1000 * point.steps end,
  unit = function(point)
    local place, state = 0, point.seed
    for i = 1, point.steps do
      state = (1103515245 * state + 12345) % 2147483648
      place = place + point.size * (state / 2147483648 - 0.5)
    end
    return {place = place, word = place > 0 and "right" or nil}
  end,
  report = function(results, folder)
    s.save_text(folder .. "/report.txt", #results.rows .. " rows, " .. #results.gaps .. " gaps")
  end,
}
)";

class Scratch : public springlod::test::SweepScratch {
 public:
  explicit Scratch(const std::string& script = kWalk) : SweepScratch(script) {}
};

bool wait_for(const fs::path& path) {
  for (int i = 0; i < 2000 && !fs::exists(path); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return fs::exists(path);
}

std::string with(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

}  // namespace

TEST_CASE("A sweep is planned, run and merged") {
  const Scratch scratch;
  CHECK_THAT(scratch.must({"plan", "walk.lua", "--out", "out"}),
             Contains("12 units (4 steps x 3 size)") && Contains("1 task"));
  CHECK_THAT(scratch.must({"status", "out"}), Contains("0 of 12 units done, 12 missing"));
  CHECK_THAT(scratch.must({"run", "out"}), Contains("12 of 12 units done"));
  const auto rows = rows_of(scratch.merged());
  REQUIRE(rows.size() == 12);
  CHECK(rows[0].at("steps") == "10");
  CHECK(rows[1].at("size") == "0.5");  // the last axis varies fastest
  CHECK(rows[11].at("unit") == "12");
  CHECK(slurp(scratch / "out/report.txt") == "12 rows, 0 gaps");
  const auto runs = rows_of(slurp(scratch / "out/runs.csv"));
  REQUIRE(runs.size() == 12);
  CHECK_FALSE(runs[0].at("target").empty());
  CHECK(std::stod(runs[0].at("memory")) > 1e6);
}

TEST_CASE("A sweep task by task gives the same bytes as all at once") {
  const Scratch scratch(with(kWalk, "1000 * point.steps", "1e11"));
  scratch.plan("whole");
  scratch.plan("tasks");
  scratch.must({"run", "whole"});
  const auto plan = nlohmann::json::parse(slurp(scratch / "tasks/plan.json"));
  const std::size_t tasks = plan.at("tasks").size();
  REQUIRE(tasks > 1);
  for (std::size_t task = tasks; task-- > 0;)
    scratch.must({"run", "tasks", "--task", std::to_string(task)});
  CHECK(scratch.merged("whole") == scratch.merged("tasks"));
}

TEST_CASE("A finished unit is not run again, and resume runs what is missing") {
  const Scratch scratch;
  scratch.plan();
  scratch.must({"run", "out"});
  const std::string before = scratch.merged();
  const fs::path kept = scratch / "out/results/0000/0000003.json";
  const std::string bytes = slurp(kept);
  fs::remove(scratch / "out/results/0000/0000004.json");
  CHECK_THAT(scratch.must({"status", "out"}), Contains("11 of 12 units done, 1 missing"));
  scratch.must({"resume", "out"});
  CHECK(slurp(kept) == bytes);  // with the time that it took
  CHECK(scratch.merged() == before);
}

TEST_CASE("A unit that fails is recorded, named in the tables and not run again") {
  const Scratch scratch(
      with(kWalk, "local place,", "if point.index == 5 then error('no way') end\n local place,"));
  scratch.plan();
  CHECK_THAT(scratch.must({"run", "out"}), Contains("11 of 12 units done, 1 failed"));
  CHECK_THAT(scratch.must({"merge", "out"}), Contains("unit 5") && Contains("no way"));
  CHECK_THAT(rows_of(slurp(scratch / "out/results.csv")).at(4).at("missing"), Contains("no way"));
  const auto gaps = rows_of(slurp(scratch / "out/gaps.csv"));
  REQUIRE(gaps.size() == 1);
  CHECK(gaps[0].at("state") == "failed");
  CHECK_FALSE(gaps[0].at("host").empty());
  CHECK(fs::exists(scratch / "out" / gaps[0].at("log")));
  CHECK(slurp(scratch / "out/report.txt") == "11 rows, 1 gaps");
  const fs::path record = scratch / "out/results/0000/0000004.failed.json";
  const std::string bytes = slurp(record);
  scratch.must({"resume", "out"});
  CHECK(slurp(record) == bytes);
  CHECK_THAT(scratch.must({"resume", "out", "--again"}), Contains("1 unit to be tried again"));
  CHECK(slurp(record) != bytes);  // another time
}

TEST_CASE("Rows of a unit keep their order, and gaps fill no column") {
  const Scratch scratch(R"(
local s = require "springlod"
return s.sweep{count = 4, columns = {"n", "host"}, unit = function(point)
  if point.index == 2 then error("no") end
  local rows = {}
  for n = 1, 20 do rows[n] = {n = n} end
  return rows
end})");
  scratch.plan();
  scratch.must({"run", "out"});
  const auto rows = rows_of(scratch.merged());
  REQUIRE(rows.size() == 61);
  for (int i = 0; i < 20; ++i) CHECK(rows[i].at("n") == std::to_string(i + 1));
  CHECK(rows[20].at("unit") == "2");
  CHECK(rows[20].at("host").empty());
  CHECK_THAT(rows[20].at("missing"), Contains("no"));
  CHECK(rows[60].at("n") == "20");
}

TEST_CASE("A unit without rows has a line in the table") {
  const Scratch scratch(R"(
local s = require "springlod"
return s.sweep{axes = {{"height", {0.1, 0.2, 0.3, 0.4}}}, columns = {"time"},
  unit = function(point)
    if point.height == 0.3 then error("no floor", 0) end
    return {time = point.height > 0.1 and 10 * point.height or nil}
  end})");
  scratch.plan();
  scratch.must({"run", "out"});
  const auto rows = rows_of(scratch.merged());
  REQUIRE(rows.size() == 4);
  CHECK(rows[0].at("height") == "0.1");
  CHECK(rows[0].at("time").empty());
  CHECK(rows[0].at("missing").empty());
  CHECK(rows[1].at("time") == "2");
  CHECK(rows[2].at("missing") == "failed: no floor");
  CHECK(rows[3].at("unit") == "4");
}

TEST_CASE("A report that fails leaves the tables") {
  const Scratch scratch(R"(
local s = require "springlod"
return s.sweep{count = 2, columns = {"n"}, unit = function(point) return {n = point.index} end,
  report = function() error("nothing to draw", 0) end})");
  scratch.plan();
  scratch.must({"run", "out"});
  const Ran ran = scratch.run({"merge", "out"});
  CHECK(ran.exit_code == 1);
  CHECK_THAT(ran.err, Contains("sweep merge: report fails: nothing to draw; the tables are") &&
                          Contains("mend the cause and merge again"));
  CHECK(rows_of(slurp(scratch / "out/results.csv")).size() == 2);
}

TEST_CASE("Damaged results are gaps that say what to do") {
  const Scratch scratch;
  scratch.plan();
  scratch.must({"run", "out"});
  const std::string before = scratch.merged();
  const fs::path results = scratch / "out/results/0000";
  fs::resize_file(results / "0000003.json", 0);
  fs::resize_file(results / "0000007.json", 20);
  CHECK_THAT(scratch.must({"merge", "out"}),
             Contains("2 units without a result") && Contains("remove it and resume"));
  const auto gaps = rows_of(slurp(scratch / "out/gaps.csv"));
  REQUIRE(gaps.size() == 2);
  CHECK(gaps[0].at("unit") == "4");
  CHECK(gaps[0].at("state") == "damaged");
  CHECK_THAT(gaps[1].at("message"), Contains("0000007.json"));
  fs::remove(results / "0000003.json");
  fs::remove(results / "0000007.json");
  scratch.must({"resume", "out"});
  CHECK(scratch.merged() == before);
}

TEST_CASE("Wrong rows of a unit are failures that name the column") {
  const Scratch scratch(with(kWalk, "{place = place,", "{plaice = place,"));
  scratch.plan();
  scratch.must({"run", "out"});
  scratch.must({"merge", "out"});
  CHECK_THAT(rows_of(slurp(scratch / "out/gaps.csv")).at(0).at("message"),
             Contains("plaice") && Contains("place, word"));
}

TEST_CASE("A plan whose script has changed is refused") {
  const Scratch scratch;
  scratch.plan();
  spit(scratch / "walk.lua", with(kWalk, "0.1, 0.5", "0.2, 0.5"));
  const Ran ran = scratch.run({"run", "out"});
  CHECK(ran.exit_code == 1);
  CHECK_THAT(ran.err, Contains("walk.lua has changed since the plan was made"));
  spit(scratch / "walk.lua", kWalk);
  scratch.must({"run", "out"});
  spit(scratch / "walk.lua", with(kWalk, "0.1, 0.5", "0.2, 0.5"));
  CHECK_THAT(scratch.run({"plan", "walk.lua", "--out", "out"}).err,
             Contains("holds results of another content of") && Contains("walk.lua"));
}

TEST_CASE("A file that the script reads belongs to the plan") {
  const Scratch scratch("local table = dofile('values.lua')\n" + std::string(kWalk));
  spit(scratch / "values.lua", "return {1}");
  scratch.plan();
  spit(scratch / "values.lua", "return {2}");
  CHECK_THAT(scratch.run({"run", "out"}).err, Contains("values.lua has changed"));
}

TEST_CASE("Stages run one after the other") {
  const Scratch scratch(R"(
local s = require "springlod"
return s.sweep{stages = {
  {name = "make", count = 3, columns = {"size"}, unit = function(point)
    s.save_text("made/" .. point.index .. ".txt", tostring(10 * point.index))
    return {size = point.index}
  end},
  {name = "use", axes = {{"which", {3, 2, 1}}}, columns = {"value"}, unit = function(point)
    local file <close> = assert(io.open("made/" .. point.which .. ".txt"))
    return {value = tonumber(file:read("a"))}
  end},
}})");
  scratch.plan();
  CHECK_THAT(scratch.must({"run", "out"}), Contains("6 of 6 units done"));
  scratch.must({"merge", "out"});
  CHECK(rows_of(slurp(scratch / "out/results-make.csv")).size() == 3);
  const auto rows = rows_of(slurp(scratch / "out/results-use.csv"));
  REQUIRE(rows.size() == 3);
  CHECK(rows[0].at("value") == "30");
  CHECK(rows[2].at("value") == "10");
}

TEST_CASE("Arguments of the script belong to the plan") {
  const Scratch scratch(R"(
local s = require "springlod"
local count = tonumber((...))
return s.sweep{count = count, columns = {"n"}, unit = function() return {n = count} end})");
  scratch.must({"plan", "walk.lua", "--out", "out", "--", "4"});
  CHECK_THAT(scratch.must({"run", "out"}), Contains("4 of 4 units done"));
  CHECK(rows_of(scratch.merged()).at(3).at("n") == "4");
}

TEST_CASE("Processes that are killed again and again change no result", "[long]") {
  const Scratch scratch(
      with(kWalk, "local place,",
           "local begun = os.clock() while os.clock() < begun + 0.1 do end\n local place,"));
  scratch.plan("quiet");
  scratch.must({"run", "quiet"});
  scratch.plan("killed");
  const std::vector<std::string> arguments{"-q", "sweep", "resume", "killed", "--workers", "2"};
  const fs::path program = springlod::test::build_folder() / "app/springlod";
  // The run itself, with its workers; the number of the signal is what the system does at will.
  constexpr int kMostRounds = 60;
  int killed = 0;
  for (int round = 0; round < kMostRounds; ++round) {
    const pid_t process = springlod::start_program(program, arguments, {}, scratch.path());
    std::this_thread::sleep_for(std::chrono::milliseconds(150 + 37 * (round % 7)));
    kill(process, SIGKILL);
    if (springlod::wait_for_program(process).signal == SIGKILL) ++killed;
    if (scratch.run({"status", "killed"}).out.starts_with("12 of 12")) break;
  }
  scratch.must({"resume", "killed", "--again"});
  CHECK(killed > 0);
  CHECK(scratch.merged("killed") == scratch.merged("quiet"));
}

TEST_CASE("A worker that is killed costs its unit one try") {
  const Scratch scratch(R"(
local s = require "springlod"
return s.sweep{count = 3, columns = {"n"}, unit = function(point)
  s.save_text("began-" .. point.index .. ".txt", "x")
  local begun = os.clock()
  while not s.is_folder("go") and os.clock() < begun + 20 do end
  return {n = point.index}
end})");
  scratch.plan();
  const pid_t process =
      springlod::start_program(springlod::test::build_folder() / "app/springlod",
                               {"-q", "sweep", "run", "out", "--workers", "1"}, {}, scratch.path());
  const fs::path first = scratch / "out/results/0000/0000000.try-1";
  const fs::path second = scratch / "out/results/0000/0000000.try-2";
  REQUIRE(wait_for(scratch / "began-1.txt"));
  const auto runner = nlohmann::json::parse(slurp(first));
  kill(runner.at("process").get<pid_t>(), SIGKILL);
  REQUIRE(wait_for(second));
  CHECK(nlohmann::json::parse(slurp(first)).at("signal") == SIGKILL);
  fs::create_directory(scratch / "go");
  CHECK(springlod::wait_for_program(process).exit_code == 0);
  CHECK_THAT(scratch.must({"status", "out"}), Contains("3 of 3 units done"));
  CHECK_FALSE(fs::exists(second));
}

TEST_CASE("A stage waits for units that another run has begun") {
  const Scratch scratch(R"(
local s = require "springlod"
return s.sweep{stages = {
  {name = "make", count = 2, columns = {"n"}, unit = function(point)
    s.save_text("began-" .. point.index .. ".txt", "x")
    local begun = os.clock()
    while not s.is_folder("go-" .. point.index) and os.clock() < begun + 20 do end
    s.save_text("made-" .. point.index .. ".txt", "x")
    return {n = point.index}
  end},
  {name = "use", count = 2, columns = {"text"}, unit = function(point)
    local file <close> = assert(io.open("made-" .. point.index .. ".txt"))
    return {text = file:read("a")}
  end},
}})");
  scratch.plan();
  const auto start = [&] {
    return springlod::start_program(springlod::test::build_folder() / "app/springlod",
                                    {"-q", "sweep", "run", "out", "--workers", "1"}, {},
                                    scratch.path());
  };
  const pid_t first = start();
  REQUIRE(wait_for(scratch / "began-1.txt"));
  const pid_t second = start();
  REQUIRE(wait_for(scratch / "began-2.txt"));
  fs::create_directory(scratch / "go-1");
  REQUIRE(wait_for(scratch / "out/results/0000/0000000.json"));
  // Time for the first run to begin the second stage, if it does not wait for the second unit.
  std::this_thread::sleep_for(std::chrono::seconds(1));
  fs::create_directory(scratch / "go-2");
  CHECK(springlod::wait_for_program(first).exit_code == 0);
  CHECK(springlod::wait_for_program(second).exit_code == 0);
  CHECK_THAT(scratch.must({"status", "out"}), Contains("4 of 4 units done"));
}

TEST_CASE("Wrong uses of sweep say what is wrong") {
  const Scratch scratch;
  CHECK_THAT(scratch.run({"fly", "out"}).err, Contains("'fly' must be plan, run"));
  CHECK_THAT(scratch.run({"run", "nowhere"}).err, Contains("nowhere holds no plan"));
  CHECK_THAT(scratch.run({"plan", "papers"}).err,
             Contains("'papers' is neither a file nor one of accuracy, paper"));
  scratch.plan();
  CHECK_THAT(scratch.run({"run", "out", "--task", "1"}).err, Contains("task"));
  spit(scratch / "walk.lua", "return 1");
  CHECK_THAT(scratch.run({"plan", "walk.lua", "--out", "other"}).err,
             Contains("must return s.sweep"));
}

TEST_CASE("An option that an action does not use is refused, with the actions that use it") {
  const Scratch scratch;
  const std::pair<std::vector<std::string>, const char*> kCases[] = {
      {{"status", "out", "--task", "1"}, "--task is for run, not for status"},
      {{"run", "out", "--out", "other"}, "--out is for plan, not for run"},
      {{"run", "out", "--hosts", "h"}, "--hosts is for submit and resume, not for run"},
      {{"merge", "out", "other"}, "merge takes one folder"},
      // Of several the same one is named always, whatever their order.
      {{"status", "out", "--again", "--task", "1"}, "--task is for run"},
      {{"status", "out", "--task", "1", "--again"}, "--task is for run"},
      {{"resume", "out", "--time", "10min"}, "--time needs --engine"},
      {{"resume", "out", "--engine", "slurm", "--workers", "2"}, "--workers is for this machine"},
  };
  for (const auto& [arguments, message] : kCases) {
    const Ran ran = scratch.run(arguments);
    CAPTURE(arguments, ran.err);
    CHECK(ran.exit_code == 2);
    CHECK_THAT(ran.err, Contains(message));
  }
  CHECK_THAT(scratch.run({"submit", "out", "--hosts", "h"}).err,
             Contains("--hosts is for --engine parallel; this is --engine slurm"));
  CHECK_THAT(
      scratch.run({"submit", "out", "--engine", "parallel", "--sbatch=--partition=long"}).err,
      Contains("--sbatch is for --engine slurm"));
}

TEST_CASE("Sweeps that make no sense are refused") {
  const std::pair<const char*, const char*> kCases[] = {
      {"count = 2", "unit"},
      {"unit = print", "count"},
      {"count = 2, axes = {{'a', {1}}}, unit = print", "not both"},
      {"count = 0, unit = print", "1 to"},
      {"axes = {{'a', {}}}, unit = print", "'a' has none"},
      {"axes = {{'a', {1}}, {'a', {2}}}, unit = print", "'a'"},
      {"axes = {{'seed', {1}}}, unit = print", "'seed'"},
      {"axes = {{'host', {1}}}, unit = print", "'host'"},
      {"axes = {{'', {1}}}, unit = print", "''"},
      {"axes = {{'a', {print}}}, unit = print", "a function"},
      {"count = 2, unit = print, stages = {}", "inside the stages"},
      {"stages = {}", "at least one stage"},
  };
  for (const auto& [options, message] : kCases) {
    const Ran ran = springlod_run({"-e", fmt::format("require('springlod').sweep{{{}}}", options)});
    CAPTURE(options, ran.err);
    CHECK(ran.exit_code == 1);
    CHECK_THAT(ran.err, Contains(message));
  }
}

TEST_CASE("A unit is tried at the prompt") {
  const Scratch scratch;
  const Ran ran = springlod_run({"-e",
                                 "local sweep = dofile('walk.lua') print(sweep) "
                                 "print(sweep:point(2).size, sweep:run(2)[1].place, sweep.units)"},
                                "", scratch.path());
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  CHECK_THAT(ran.out,
             Contains("Sweep: 12 units (4 steps x 3 size)") && Contains("0.5") && Contains("12"));
}
