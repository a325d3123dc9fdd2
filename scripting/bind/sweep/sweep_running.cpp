// Planning and running sweeps.

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <unistd.h>

#include "base/error.hpp"
#include "base/progress.hpp"
#include "base/subprocess.hpp"
#include "elastic/solver/dense_kernels.hpp"
#include "scripting/bind/sweep/sweep_program.hpp"
#include "scripting/bind/sweep/sweep_value.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "scripting/engine/paths.hpp"
#include "sim/fast/vector_target.hpp"
#include "sweep/pack_tasks.hpp"
#include "sweep/plan.hpp"
#include "sweep/run_plan.hpp"
#include "sweep/work.hpp"

namespace springlod::scripting {

namespace {

namespace fs = std::filesystem;
using sweep::Plan;
using sweep::UnitFiles;

constexpr const char* kGroup = "Sweeps";

std::vector<sweep::Stage> stages_of(const SweepValue& value) {
  std::vector<sweep::Stage> stages;
  for (const SweepStage& stage : value.stages)
    stages.push_back({stage.name, stage.units, stage.columns, stage.waits, stage.alone});
  return stages;
}

bool are_same(const std::vector<sweep::Stage>& a, const std::vector<sweep::Stage>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const sweep::Stage& one, const sweep::Stage& other) {
                      return one.name == other.name && one.units == other.units &&
                             one.columns == other.columns;
                    });
}

/// The regular files that the script has read, but for those of the program.
std::vector<fs::path> files_read(Session& session, const fs::path& folder) {
  std::vector<fs::path> paths;
  const fs::path own = fs::weakly_canonical(stock_script_folder());
  const fs::path out = fs::weakly_canonical(folder);
  for (const fs::path& path : session.files().read()) {
    std::error_code error;
    const auto is_below = [&](const fs::path& parent) {
      return std::mismatch(parent.begin(), parent.end(), path.begin(), path.end()).first ==
             parent.end();
    };
    if (fs::is_regular_file(path, error) && !is_below(own) && !is_below(out)) paths.push_back(path);
  }
  return paths;
}

void estimate_costs(Call& call, const SweepValue& value, const std::string& folder, Plan& plan) {
  constexpr std::uint64_t kLook = 1000;  // units between two looks whether the user stops it
  Task task(call.progress(), "estimating costs", value.unit_count());
  for (std::uint64_t unit = 0; unit < value.unit_count(); ++unit) {
    if (unit % kLook == 0) task.advance(unit == 0 ? 0 : kLook);
    sweep::add_cost(plan.costs, cost_of(call.lua(), {value, unit, folder}));
  }
}

/// The unit of the first stage whose cost is the given share of the way from the cheapest to the
/// dearest, by number of units.
std::uint64_t unit_at_share(const Plan& plan, double share) {
  std::vector<std::pair<double, std::uint64_t>> costs;  // of the units of the first stage
  std::uint64_t first = 0;
  for (const sweep::CostRun& run : plan.costs) {
    if (first < plan.stages.front().units) costs.emplace_back(run.cost, first);
    first += run.units;
  }
  std::sort(costs.begin(), costs.end());
  return costs[static_cast<std::size_t>(share * static_cast<double>(costs.size() - 1))].second;
}

/// Runs units that should be short, and makes the estimate of the time fit to what they take: small
/// bodies take longer than their springs tell. A unit that fails tells nothing.
void adjust_time(Call& call, const SweepValue& value, const std::string& folder, Plan& plan) {
  constexpr double kShares[] = {0.0, 0.5, 0.9};
  constexpr double kLongest = 1;  // of a unit to be run [s]
  double seconds = 0, estimated = 0;
  for (const double share : kShares) {
    const std::uint64_t unit = unit_at_share(plan, share);
    const double cost = cost_of(call.lua(), {value, unit, folder});
    if (cost * plan.seconds_per_cost > kLongest) continue;
    const std::clock_t begun = std::clock();  // of all threads
    try {
      run_unit(call.lua(), {value, unit, folder});
    } catch (const InputError& error) {
      call.session().console().say(fmt::format("unit {} fails: {}", unit + 1, error.what()));
      continue;
    }
    seconds += static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
    estimated += cost * plan.seconds_per_cost;
  }
  if (seconds > 0 && estimated > 0) plan.seconds_per_cost *= seconds / estimated;
}

int plan_binding(Call& call) {
  const auto value = call.value<SweepValue>(1);
  const fs::path folder = call.writable(2);
  Plan plan{.version = version(), .program = program_hash()};
  std::string script;
  bool pilot = false;
  TableReader options = call.options(3);
  options.read("script", script);
  options.read("arguments", plan.arguments);
  options.read("seconds_per_cost", plan.seconds_per_cost);
  options.read("pilot", pilot);
  options.finish();
  if (script.empty()) options.refuse("script", "the path of the script that returns the sweep");
  plan.script = fs::absolute(script).lexically_normal().string();
  plan.folder = fs::current_path().string();
  plan.seed = call.session().settings().seed;
  plan.sandbox = call.session().settings().sandbox;
  plan.portable = call.session().settings().portable;
  plan.stages = stages_of(*value);
  const std::string of_points = fs::absolute(folder).string();
  estimate_costs(call, *value, of_points, plan);
  if (pilot) adjust_time(call, *value, of_points, plan);
  plan.files = sweep::hash_files(files_read(call.session(), folder));
  sweep::pack_tasks(plan);
  sweep::require_own_results(folder, plan);
  sweep::write_plan(folder, plan);
  begin_table(call.lua());
  set_field(call.lua(), "units", plan.unit_count());
  set_field(call.lua(), "tasks", plan.tasks.size());
  set_field(call.lua(), "seconds", plan.total_cost() * plan.seconds_per_cost);
  set_field(call.lua(), "files", plan.files.size());
  return 1;
}

std::uint32_t core_count() {
  return std::max(1U, std::thread::hardware_concurrency());
}

/// Arguments of springlod that run an action of springlod sweep which needs the script. Files that
/// the arguments of the script name may be used by it.
std::vector<std::string> script_arguments(const Plan& plan, const fs::path& folder,
                                          std::uint32_t threads,
                                          const std::vector<std::string>& action) {
  std::vector<std::string> arguments;
  if (!plan.sandbox) arguments.emplace_back("--unsafe");
  if (plan.portable) arguments.emplace_back("--portable");
  arguments.insert(arguments.end(), {"--seed", std::to_string(plan.seed), "--threads",
                                     std::to_string(threads), "sweep"});
  arguments.insert(arguments.end(), action.begin(), action.end());
  arguments.insert(arguments.end(), {fs::absolute(folder).string(), "--", plan.script});
  arguments.insert(arguments.end(), plan.arguments.begin(), plan.arguments.end());
  return arguments;
}

int run_binding(Call& call) {
  const fs::path folder = call.writable(1);
  const Plan plan = checked_plan(call.session(), folder);
  sweep::RunOptions run{.program = this_program(), .progress = call.progress()};
  std::optional<std::uint64_t> task;
  std::optional<std::uint32_t> workers;
  TableReader options = call.options(2);
  options.read("task", task);
  options.read("workers", workers);
  options.finish();
  if (task && *task >= plan.tasks.size())
    options.refuse("task", fmt::format("0 to {}", plan.tasks.size() - 1));
  if (task) run.task = *task;
  const std::uint32_t given = call.session().settings().threads;
  const std::uint32_t cores = given == 0 ? core_count() : given;
  run.workers = std::max(1U, workers.value_or(task ? 1 : cores));
  run.arguments = [&, threads = std::max(1U, cores / run.workers)](const std::string& log) {
    return script_arguments(plan, folder, threads, {"--log=" + log, "work"});
  };
  sweep::RunCounts counts;
  try {
    counts = sweep::run_plan(plan, UnitFiles(folder), run);
  } catch (const IoError& error) {
    throw IoError(fmt::format("{}. Finished units are kept: mend the cause, then {}", error.what(),
                              shell_line("springlod", {"sweep", "resume", folder.string()})));
  }
  begin_table(call.lua());
  set_field(call.lua(), "done", counts.done);
  set_field(call.lua(), "failed", counts.failed);
  set_field(call.lua(), "lost", counts.lost);
  return 1;
}

int merge_binding(Call& call) {
  const fs::path folder = call.writable(1);
  const Plan plan = sweep::read_plan(folder);
  std::vector<std::string> action{"gather"};
  if (call.session().settings().verbosity == Verbosity::quiet) action.insert(action.begin(), "-q");
  const ProcessEnd end = wait_for_program(
      start_program(this_program(), script_arguments(plan, folder, 0, action),
                    {.output = STDOUT_FILENO, .errors = STDERR_FILENO}, plan.folder));
  if (end.signal != 0 || end.exit_code != 0)
    throw InputError(
        "it ended with an error, see above; all results are kept: mend the cause and merge again");
  return 0;
}

int work_binding(Call& call) {
  const auto value = call.value<SweepValue>(1);
  const fs::path folder = call.writable(2);
  const Plan plan = checked_plan(call.session(), folder);
  if (!are_same(plan.stages, stages_of(*value)))
    throw InputError(
        "the script describes other units than when the plan was made: a sweep must "
        "not depend on the time, the machine or files that change");
  const std::string of_points = fs::absolute(folder).string();
  sweep::serve_units(
      UnitFiles(folder),
      {.version = version(),
       .target = sim::vector_target(),
       .blas = elastic::blas_kernels(),
       .log = call.text(3)},
      [&](std::uint64_t unit) {
        return run_unit(call.lua(), {*value, unit, of_points});
      },
      kExtraStream);
  return 0;
}

}  // namespace

void describe_sweep_running(Api& api) {
  api.add(FunctionEntry{
      .name = "plan_sweep",
      .group = kGroup,
      .summary = "Writes the plan of a sweep to a folder, plan.json: what the results depend on, "
                 "what each unit costs, and how they are packed into tasks of 30 to 60 s. Results "
                 "that the folder has from the same plan are kept.",
      .arguments = {sweep_argument(),
                    {.name = "folder", .type = "string", .help = "folder to write to"}},
      .options = {{.name = "script",
                   .type = "string",
                   .help = "path of the script that returns the sweep"},
                  {.name = "arguments",
                   .type = "list of strings",
                   .fallback = "none",
                   .help = "arguments of the script"},
                  {.name = "seconds_per_cost",
                   .type = "number",
                   .range = Range{0, 1e9},
                   .fallback = "0",
                   .help = "time of a spring update, or of a unit without cost, on one core [s]"},
                  {.name = "pilot",
                   .type = "boolean",
                   .fallback = "false",
                   .help = "runs up to three units of the first stage that should take less than a "
                           "second, to make seconds_per_cost fit"}},
      .returns = "table: units, tasks, seconds (estimated, of one core), files (that were read)",
      .errors = "cost fails; the folder holds results of another plan; it cannot be written to.",
      .example = "s.plan_sweep(sweep, \"out/drops\", {script = \"drops.lua\"})",
      .call = plan_binding});
  api.add(FunctionEntry{
      .name = "run_sweep",
      .group = kGroup,
      .summary = "Runs the units of a plan that have no result yet, in processes of their own.",
      .arguments = {sweep_folder_argument()},
      .options = {{.name = "task",
                   .type = "integer",
                   .fallback = "all",
                   .help = "runs one task, counted from 0"},
                  {.name = "workers",
                   .type = "integer",
                   .range = Range{1, 1024},
                   .fallback = "one per core; for a task, 1",
                   .help = "number of processes"}},
      .returns = "table: numbers of units done, failed and lost",
      .errors = "There is no plan; the program or a file has changed since; a process cannot work "
                "(a full disk). Failed units are no errors.",
      .example = "s.run_sweep(\"out/drops\")",
      .call = run_binding});
  api.add(FunctionEntry{
      .name = "merge_sweep",
      .group = kGroup,
      .summary =
          "Writes the results of a plan as tables into its folder, and what the script makes "
          "of them, in a process of its own: as springlod sweep merge.",
      .arguments = {sweep_folder_argument()},
      .returns = "nothing",
      .errors = "There is no plan; the script or its report fails.",
      .example = "s.merge_sweep(\"out/drops\")",
      .call = merge_binding});
  api.add(FunctionEntry{
      .name = "work_on_sweep",
      .group = kGroup,
      .summary = "Runs the units that s.run_sweep asks for, in a process that it has started.",
      .arguments = {sweep_argument(),
                    sweep_folder_argument(),
                    {.name = "log", .type = "string", .help = "where the process prints to"}},
      .returns = "nothing",
      .errors = "As s.run_sweep; the script describes other units than when the plan was made.",
      .example = "s.work_on_sweep(sweep, \"out/drops\", \"logs/1.log\")",
      .call = work_binding});
}

}  // namespace springlod::scripting
