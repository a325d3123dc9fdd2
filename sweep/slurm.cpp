#include "sweep/slurm.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.hpp"
#include "base/subprocess.hpp"
#include "sweep/task_list.hpp"

namespace springlod::sweep {

namespace {

namespace fs = std::filesystem;

/// The limit of a task over its estimated time: other nodes are slower, and share their memory with
/// other jobs. At least ten minutes, so that a bad estimate of short units does no harm.
constexpr double kTimeMargin = 4, kLeastTime = 600;
/// A task gets the signal to end this long before its time limit [s].
constexpr int kNotice = 60;

double longest_task(const Plan& plan) {
  double longest = 0, seconds = 0;
  std::size_t task = 0;
  for_each_unit(plan, [&](std::uint64_t unit, double cost) {
    if (unit == plan.end_of_task(task)) {
      ++task;
      seconds = 0;
    }
    seconds += cost * plan.seconds_per_cost;
    longest = std::max(longest, seconds);
  });
  return longest;
}

/// As sbatch reads it: minutes.
std::string time_text(double seconds) {
  constexpr double kMinute = 60;
  return fmt::format("{:.0f}", std::ceil(seconds / kMinute));
}

std::string memory_text(std::uint64_t bytes) {
  constexpr std::uint64_t kMegabyte = std::uint64_t{1} << 20;
  return fmt::format("{}M", (bytes + kMegabyte - 1) / kMegabyte);
}

std::vector<std::string> common_arguments(const Plan& plan, double seconds,
                                          const SlurmOptions& options) {
  std::vector<std::string> arguments{"--parsable",
                                     "--requeue",
                                     "--open-mode=append",
                                     "--ntasks=1",
                                     "--cpus-per-task=1",
                                     "--time=" + time_text(seconds),
                                     "--mem=" + memory_text(options.memory)};
  arguments.push_back("--chdir=" + plan.folder);
  arguments.insert(arguments.end(), options.options.begin(), options.options.end());
  return arguments;
}

/// "exec springlod sweep run FOLDER --task N" of the line of a list of tasks that the job's number
/// in its array tells. It is what gets the signal that the limit is near.
std::string array_command(const fs::path& folder, const fs::path& list,
                          const SlurmOptions& options) {
  return fmt::format(
      "exec {} --task $(sed -n \"$((1 + SLURM_ARRAY_TASK_ID))p\" {})",
      shell_line(options.program.string(), {"--quiet", "sweep", "run", folder.string()}),
      shell_word(list.string()));
}

fs::path sbatch() {
  const auto found = find_program("sbatch");
  if (!found)
    throw IoError(
        "sbatch is not installed here: run this on a machine of the cluster from which "
        "jobs are submitted, or use --engine parallel");
  return *found;
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

/// Of the jobs of each phase: the numbers that come after "afterany:".
std::string dependency(const std::map<std::size_t, std::vector<std::string>>& numbers,
                       std::size_t phase) {
  const auto before = numbers.lower_bound(phase);
  if (before == numbers.begin()) return "";
  return fmt::format("--dependency=afterany:{}", fmt::join(std::prev(before)->second, ":"));
}

}  // namespace

std::vector<SlurmJob> slurm_jobs(const Plan& plan, const fs::path& folder,
                                 const std::vector<std::size_t>& tasks, std::uint64_t largest_array,
                                 const SlurmOptions& options) {
  const double seconds = options.seconds > 0
                             ? options.seconds
                             : std::max(kLeastTime, kTimeMargin * longest_task(plan));
  std::error_code ignored;
  fs::create_directories(folder / "logs", ignored);  // Slurm makes none
  std::vector<SlurmJob> jobs;
  for (const PhaseTasks& some : by_phase(plan, tasks, largest_array)) {
    SlurmJob job{.arguments = common_arguments(plan, seconds, options), .phase = some.phase};
    const std::string at_once = options.at_once > 0 ? fmt::format("%{}", options.at_once) : "";
    job.arguments.push_back(fmt::format("--array=0-{}{}", some.tasks.size() - 1, at_once));
    if (some.alone) job.arguments.push_back("--exclusive");
    job.arguments.push_back(fmt::format("--signal=B:TERM@{}", kNotice));
    job.arguments.push_back("--output=" + (folder / "logs/slurm-%A-%a.log").string());
    job.arguments.push_back("--job-name=" + folder.filename().string());
    job.arguments.push_back("--wrap=" +
                            array_command(folder, write_task_list(folder, some.tasks), options));
    jobs.push_back(std::move(job));
  }
  SlurmJob merge{.arguments = common_arguments(plan, seconds, options),
                 .phase = plan.stages.size()};
  merge.arguments.push_back("--output=" + (folder / "logs/slurm-merge-%j.log").string());
  merge.arguments.push_back("--job-name=" + folder.filename().string() + "-merge");
  merge.arguments.push_back(
      "--wrap=exec " + shell_line(options.program.string(), {"sweep", "merge", folder.string()}));
  jobs.push_back(std::move(merge));
  return jobs;
}

std::string slurm_script(const std::vector<SlurmJob>& jobs) {
  std::string script = "#!/bin/sh\nset -e\n";
  std::map<std::size_t, std::vector<std::string>> numbers;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const std::string variable = fmt::format("job{}", i + 1);
    std::string words = shell_line("sbatch", jobs[i].arguments);
    const std::string after = dependency(numbers, jobs[i].phase);
    if (!after.empty()) words.insert(std::string("sbatch").size(), " \"" + after + "\"");
    script += fmt::format("{}=$({})\n", variable, words);
    numbers[jobs[i].phase].push_back("${" + variable + "%%;*}");
  }
  return script;
}

std::vector<std::string> submit_to_slurm(const std::vector<SlurmJob>& jobs) {
  const fs::path program = sbatch();
  std::map<std::size_t, std::vector<std::string>> numbers;
  std::vector<std::string> all;
  for (const SlurmJob& job : jobs) {
    std::vector<std::string> arguments = job.arguments;
    const std::string after = dependency(numbers, job.phase);
    if (!after.empty()) arguments.insert(arguments.begin(), after);
    const ProgramResult result = run_program(program, arguments);
    if (result.exit_code != 0) {
      if (const auto cancel = find_program("scancel"); cancel && !all.empty())
        run_program(*cancel, all);
      throw IoError(
          fmt::format("Slurm refuses the jobs: {}; none was submitted: submit again with "
                      "other options",
                      first_line(result.errors)));
    }
    // "1234" or "1234;cluster"
    all.push_back(result.output.substr(0, result.output.find_first_of(";\n")));
    numbers[job.phase].push_back(all.back());
  }
  return all;
}

std::uint64_t largest_slurm_array(bool guess) {
  constexpr std::uint64_t kUsual = 1001;
  if (!guess) sbatch();
  const auto control = find_program("scontrol");
  const ProgramResult result =
      control ? run_program(*control, {"show", "config"}) : ProgramResult{1, {}, {}};
  if (result.exit_code != 0 && guess) return kUsual;
  if (result.exit_code != 0)
    throw IoError(fmt::format("Slurm does not answer: {}; try again when it does",
                              first_line(result.errors)));
  const std::size_t at = result.output.find("MaxArraySize");
  const std::size_t digits = result.output.find_first_of("0123456789", at);
  if (at == std::string::npos || digits == std::string::npos)
    throw IoError("scontrol show config has no MaxArraySize; is this Slurm?");
  return std::max<std::uint64_t>(1, std::stoull(result.output.substr(digits)));
}

}  // namespace springlod::sweep
