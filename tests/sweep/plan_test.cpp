#include "sweep/plan.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/random.hpp"
#include "sweep/pack_tasks.hpp"
#include "sweep/task_list.hpp"
#include "tests/support/temporary_folder.hpp"

namespace springlod::sweep {
namespace {

using Catch::Matchers::Contains;
using test::TemporaryFolder;

/// Units of one stage with the given costs in seconds.
Plan plan_of(const std::vector<double>& seconds) {
  Plan plan{.version = "1", .program = "p", .script = "/s.lua", .folder = "/"};
  plan.stages = {{"units", seconds.size(), {"x"}}};
  plan.seconds_per_cost = 1;
  for (const double cost : seconds) add_cost(plan.costs, cost);
  pack_tasks(plan);
  return plan;
}

std::vector<double> task_seconds(const Plan& plan, const std::vector<double>& seconds) {
  std::vector<double> sums;
  for (std::size_t task = 0; task < plan.tasks.size(); ++task) {
    sums.push_back(0);
    for (std::uint64_t unit = plan.tasks[task]; unit < plan.end_of_task(task); ++unit)
      sums.back() += seconds[unit];
  }
  return sums;
}

TEST_CASE("Equal neighbouring costs are kept as one run") {
  const Plan plan = plan_of({1, 1, 2, 1});
  REQUIRE(plan.costs.size() == 3);
  CHECK(plan.costs[0].units == 2);
  CHECK(plan.total_cost() == 5);
}

TEST_CASE("Tasks of short units take 30 to 60 s") {
  RandomStream random(7);
  for (int round = 0; round < 20; ++round) {
    std::vector<double> seconds(2000);
    for (double& one : seconds) one = 15 * random.unit();
    const Plan plan = plan_of(seconds);
    std::vector<double> sums = task_seconds(plan, seconds);
    sums.pop_back();  // what is left
    for (const double sum : sums) {
      CHECK(sum >= kShortestTask);
      CHECK(sum <= kLongestTask);
    }
  }
}

TEST_CASE("Tasks can be shared evenly by few processors") {
  for (const std::size_t units : {1000, 1070, 5000}) {
    const std::vector<double> seconds(units, 1.0);
    const Plan plan = plan_of(seconds);
    CAPTURE(units);
    CHECK(plan.tasks.size() % 12 == 0);
    const std::vector<double> sums = task_seconds(plan, seconds);
    for (std::size_t task = 0; task + 1 < sums.size(); ++task) {
      CHECK(sums[task] >= kShortestTask);
      CHECK(sums[task] <= kLongestTask);
    }
  }
  CHECK(plan_of(std::vector<double>(100, 1.0)).tasks.size() == 2);
}

TEST_CASE("A unit longer than a task is a task of its own") {
  const Plan plan = plan_of({500, 1, 1, 500, 500});
  CHECK(plan.tasks == std::vector<std::uint64_t>{0, 1, 3, 4});
}

TEST_CASE("A task ends with its stage") {
  Plan plan = plan_of({1, 1, 1, 1});
  plan.stages = {{"first", 3, {}}, {"second", 1, {}}};
  pack_tasks(plan);
  CHECK(plan.tasks == std::vector<std::uint64_t>{0, 3});
  CHECK(plan.end_of_task(0) == 3);
  CHECK(plan.end_of_task(1) == 4);
  CHECK(plan.stage_of(2) == 0);
  CHECK(plan.stage_of(3) == 1);
  CHECK(plan.first_unit(1) == 3);
}

TEST_CASE("Stages that do not wait run with the one before them") {
  Plan plan = plan_of({1, 1, 1, 1, 1});
  plan.stages = {{.name = "models", .units = 1},
                 {.name = "falls", .units = 1},
                 {.name = "throws", .units = 2, .waits = false},
                 {.name = "times", .units = 1, .alone = true}};
  pack_tasks(plan);
  const std::vector<Phase> phases = plan.phases();
  REQUIRE(phases.size() == 3);
  CHECK(phases[1].first == 1);
  CHECK(phases[1].end == 3);
  CHECK_FALSE(phases[1].alone);
  CHECK(phases[2].alone);
  const std::vector<PhaseTasks> lists = by_phase(plan, {0, 1, 2, 3}, 10);
  REQUIRE(lists.size() == 3);
  CHECK(lists[1].tasks == std::vector<std::size_t>{1, 2});
  CHECK(lists[2].alone);
  CHECK(by_phase(plan, {1, 2}, 1).size() == 2);
  const TemporaryFolder folder;
  write_plan(folder.path(), plan);
  const Plan read = read_plan(folder.path());
  CHECK_FALSE(read.stages[2].waits);
  CHECK(read.stages[3].alone);
}

TEST_CASE("Units without cost are packed too") {
  const Plan plan = plan_of(std::vector<double>(100, 0));
  CHECK(plan.tasks == std::vector<std::uint64_t>{0});
}

TEST_CASE("A plan is read as it was written") {
  const TemporaryFolder folder;
  Plan plan = plan_of({1, 100, 0.1});
  plan.arguments = {"--quick", "a b"};
  plan.files = {{"/a", "1"}};
  plan.seed = 12345678901234567890U;
  plan.sandbox = false;
  plan.portable = true;
  write_plan(folder.path(), plan);
  const Plan read = read_plan(folder.path());
  CHECK(read.arguments == plan.arguments);
  CHECK(read.seed == plan.seed);
  CHECK(read.sandbox == plan.sandbox);
  CHECK(read.portable == plan.portable);
  CHECK(read.tasks == plan.tasks);
  CHECK(read.total_cost() == plan.total_cost());
  CHECK(read.stages.at(0).columns == plan.stages[0].columns);
  REQUIRE_NOTHROW(require_unchanged(plan_of({1}), "1", "p"));
}

TEST_CASE("Damaged, newer and missing plans are named") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(read_plan(folder.path()), Contains("holds no plan") && Contains("sweep plan"));
  write_text_file(plan_path(folder.path()), "{\"format\": 1}");
  CHECK_THROWS_WITH(read_plan(folder.path()), Contains("damaged"));
  write_text_file(plan_path(folder.path()), "{\"format\": 99}");
  CHECK_THROWS_WITH(read_plan(folder.path()), Contains("newer springlod"));
  write_plan(folder.path(), plan_of({100, 100}));
  nlohmann::json json = nlohmann::json::parse(read_file(plan_path(folder.path())));
  for (const nlohmann::json& tasks :
       {nlohmann::json{0, 0}, nlohmann::json{0, 9}, nlohmann::json{1}}) {
    json["tasks"] = tasks;
    write_text_file(plan_path(folder.path()), json.dump());
    CHECK_THROWS_WITH(read_plan(folder.path()), Contains("damaged"));
  }
}

TEST_CASE("A plan whose program or files changed is refused") {
  const TemporaryFolder folder;
  write_text_file(folder / "mesh.obj", "v 0 0 0");
  Plan plan = plan_of({1});
  plan.files = hash_files({folder / "mesh.obj"});
  CHECK_NOTHROW(require_unchanged(plan, "1", "p"));
  CHECK_THROWS_WITH(require_unchanged(plan, "2", "p"), Contains("springlod 1"));
  CHECK_THROWS_WITH(require_unchanged(plan, "1", "q"), Contains("program"));
  write_text_file(folder / "mesh.obj", "v 0 0 1");
  CHECK_THROWS_WITH(require_unchanged(plan, "1", "p"), Contains("mesh.obj has changed"));
  std::filesystem::remove(folder / "mesh.obj");
  CHECK_THROWS_WITH(require_unchanged(plan, "1", "p"), Contains("mesh.obj is missing"));
}

}  // namespace
}  // namespace springlod::sweep
