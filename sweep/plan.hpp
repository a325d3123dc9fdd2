#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

// A plan describes many independent computations, its units, so that any machine can run any of
// them: which script defines them, what their results depend on, what each of them costs, and how
// they are packed into tasks for a cluster.

namespace springlod::sweep {

/// A file that the results depend on.
struct SourceFile {
  std::string path{};  ///< absolute
  std::string hash{};  ///< content_hash
};

/// Neighbouring units of the same cost.
struct CostRun {
  std::uint64_t units = 0;
  double cost = 0;  ///< of each [spring updates]
};

/// Units that may run in any order.
struct Stage {
  std::string name{};
  std::uint64_t units = 0;             ///< at least 1
  std::vector<std::string> columns{};  ///< of the rows of its results
  /// Whether it begins when those before it have ended, so that its units may read what they have
  /// written; false: it begins with the one before it.
  bool waits = true;
  bool alone = false;  ///< its units are timed: each has a machine to itself. The next stage waits
};

/// Stages that run at the same time.
struct Phase {
  std::size_t first = 0, end = 0;  ///< the stages [first, end)
  bool alone = false;
};

struct Plan {
  std::string version{};                 ///< of springlod
  std::string program{};                 ///< hash of the program and its scripts
  std::string script{};                  ///< absolute path of the file that returns the sweep
  std::vector<std::string> arguments{};  ///< of the script
  std::string folder{};                  ///< in which the script is run; absolute
  std::uint64_t seed = 1;
  bool sandbox = true;    ///< whether the script was planned without --unsafe
  bool portable = false;  ///< whether it was planned with --portable
  std::vector<SourceFile> files{};
  std::vector<Stage> stages{};
  std::vector<CostRun> costs{};  ///< in order, of all units
  double seconds_per_cost = 0;   ///< of one core of the machine that made the plan [s]
  /// The first unit of each task, ascending. A task ends before the next one, and with its stage.
  std::vector<std::uint64_t> tasks{};

  std::uint64_t unit_count() const;
  double total_cost() const;
  /// Number of the stage of a unit, and the first unit of a stage; both counted from 0.
  std::size_t stage_of(std::uint64_t unit) const;
  std::uint64_t first_unit(std::size_t stage) const;
  /// In order; at least one.
  std::vector<Phase> phases() const;
  /// One past the last unit of a task.
  std::uint64_t end_of_task(std::size_t task) const;
};

/// Calls visit(unit, cost) for all units, in order.
template <class Visit>
void for_each_unit(const Plan& plan, Visit visit) {
  std::uint64_t unit = 0;
  for (const CostRun& run : plan.costs)
    for (const std::uint64_t end = unit + run.units; unit < end; ++unit) visit(unit, run.cost);
}

/// Adds one unit to the list of costs.
void add_cost(std::vector<CostRun>& costs, double cost);

/// The plan of a folder is the file plan.json in it.
std::filesystem::path plan_path(const std::filesystem::path& folder);
/// With the file plan.hash. Throws IoError if it cannot be written.
void write_plan(const std::filesystem::path& folder, const Plan& plan);
/// Throws IoError if there is no plan, InputError if it is damaged or of a newer version.
Plan read_plan(const std::filesystem::path& folder);

/// Removes the plan of a folder with the results of its units, its logs and lists of tasks. Throws
/// as read_plan.
void remove_plan(const std::filesystem::path& folder);

/// Hash of what the results of a plan depend on: not of costs and tasks.
std::string results_hash(const Plan& plan);
/// Throws InputError if the folder has results of a plan with another hash than the one that it
/// keeps in plan.hash. That file is there for when the plan itself is damaged.
void require_own_results(const std::filesystem::path& folder, const Plan& plan);

/// The hashes of files, for Plan::files. Throws IoError if one cannot be read.
std::vector<SourceFile> hash_files(const std::vector<std::filesystem::path>& paths);
/// Throws InputError that names what has changed since the plan was made: its results would not
/// fit to those of before. `program`: hash of the running program.
void require_unchanged(const Plan& plan, const std::string& version, const std::string& program);

}  // namespace springlod::sweep
