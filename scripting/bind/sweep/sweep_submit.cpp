// Sweeps on clusters.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/choice.hpp"
#include "base/error.hpp"
#include "scripting/bind/sweep/sweep_program.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "sweep/gnu_parallel.hpp"
#include "sweep/plan.hpp"
#include "sweep/slurm.hpp"
#include "sweep/status.hpp"

namespace springlod::scripting {

namespace {

namespace fs = std::filesystem;

enum class Engine { slurm, parallel };
constexpr Choice<Engine> kEngines[] = {
    {Engine::slurm, "slurm", "array jobs of Slurm, and a job that merges when they have ended"},
    {Engine::parallel, "parallel",
     "GNU parallel, on machines that ssh leads to; waits for its end"},
};
constexpr ChoiceTable<Choice<Engine>> choices(Engine) {
  return {"engine", kEngines};
}

/// Throws InputError for an option of the other engine, which would do nothing.
void check_options(TableReader& options, Engine engine) {
  constexpr std::pair<const char*, Engine> kOptions[] = {{"hosts", Engine::parallel},
                                                         {"at_once", Engine::slurm},
                                                         {"time", Engine::slurm},
                                                         {"memory", Engine::slurm},
                                                         {"options", Engine::slurm}};
  for (const auto& [name, user] : kOptions)
    if (user != engine && options.has(name))
      throw InputError(fmt::format("{}: {} is for engine = \"{}\"; this is engine = \"{}\"",
                                   options.owner(), name, to_string(user), to_string(engine)));
}

int submit_binding(Call& call) {
  const fs::path folder = fs::absolute(call.writable(1)).lexically_normal();
  Engine engine = Engine::slurm;
  sweep::SlurmOptions slurm{.program = this_program()};
  sweep::ParallelOptions parallel{.program = this_program()};
  std::string hosts;
  bool dry_run = false;
  TableReader options = call.options(2);
  options.read("engine", engine);
  check_options(options, engine);
  options.read("at_once", slurm.at_once);
  options.read("time", slurm.seconds);
  options.read("memory", slurm.memory);
  options.read("options", slurm.options);
  options.read("hosts", hosts);
  options.read("dry_run", dry_run);
  options.finish();
  parallel.hosts = hosts;
  const sweep::Plan plan = checked_plan(call.session(), folder);
  const std::vector<std::size_t> tasks = sweep::unfinished_tasks(plan, sweep::UnitFiles(folder));
  if (tasks.empty()) return call.give("");
  if (engine == Engine::parallel) {
    const auto calls = sweep::parallel_calls(plan, folder, tasks, parallel);
    if (dry_run) return call.give(sweep::parallel_script(calls));
    return call.give(fmt::format("{}", sweep::run_parallel(calls)));
  }
  const std::vector<sweep::SlurmJob> jobs =
      sweep::slurm_jobs(plan, folder, tasks, sweep::largest_slurm_array(dry_run), slurm);
  if (dry_run) return call.give(sweep::slurm_script(jobs));
  return call.give(fmt::format("{}", fmt::join(sweep::submit_to_slurm(jobs), " ")));
}

}  // namespace

void describe_sweep_submit(Api& api) {
  api.add(FunctionEntry{
      .name = "submit_sweep",
      .group = "Sweeps",
      .summary = "Gives the tasks of a plan that are not finished to a cluster.",
      .arguments = {sweep_folder_argument()},
      .options = {{.name = "engine",
                   .type = "one of",
                   .fallback = "\"slurm\"",
                   .help = "what runs the tasks",
                   .choices = words_of<Engine>()},
                  {.name = "hosts",
                   .type = "string",
                   .fallback = "this machine",
                   .help = "parallel: file of ssh logins, a line each"},
                  {.name = "at_once",
                   .type = "integer",
                   .fallback = "any",
                   .help = "slurm: largest number of tasks at a time"},
                  {.name = "time",
                   .type = "quantity",
                   .dimension = Dimension::time,
                   .fallback = "4 times the estimate, at least 10 minutes",
                   .help = "slurm: limit of a task"},
                  {.name = "memory",
                   .type = "integer",
                   .range = Range{1e6, 1e13},
                   .fallback = "2 GB",
                   .help = "slurm: of a task [bytes]"},
                  {.name = "options",
                   .type = "list of strings",
                   .fallback = "none",
                   .help = "slurm: further options of sbatch, such as --partition=short"},
                  {.name = "dry_run",
                   .type = "boolean",
                   .fallback = "false",
                   .help = "returns the commands as a script, and submits nothing"}},
      .returns = "string: slurm: numbers of the jobs; parallel: number of tasks that failed; the "
                 "script of a dry run; empty if nothing is left to run",
      .errors = "There is no plan, or it does not fit the program any more; there is no Slurm "
                "or no GNU parallel; Slurm refuses the jobs (a partition that does not exist); an "
                "option of the other engine.",
      .example = "print(s.submit_sweep(\"out/drops\", {dry_run = true}))",
      .call = submit_binding});
}

}  // namespace springlod::scripting
