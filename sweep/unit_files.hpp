#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sweep/unit_result.hpp"

// The files in which units keep their results. They are all that programs on several machines
// share: each result is a file of its own, which has its name only when it is complete and on the
// disk.
//
//   results/0012/0012345.json         the result of unit 12345, counted from 0
//   results/0012/0012345.failed.json  why it failed by itself
//   results/0012/0012345.try-2        it is being run for the second time, or that run was lost

namespace springlod::sweep {

/// A unit that is lost with its machine or process is run this often; then something is wrong with
/// the unit, or with where it runs.
inline constexpr int kMostTries = 3;
/// A process shows each kBeat that it still runs a unit, and counts as lost after kSilence [s]:
/// a busy file server may show changes late.
inline constexpr double kBeat = 10, kSilence = 60;

enum class UnitState {
  missing,  ///< never run, or stopped by the user
  running,
  done,
  failed,  ///< by itself: it would fail again
  lost,    ///< with its process, kMostTries times
  waiting  ///< lost, and to be tried again
};

/// Whether a unit in this state is to be run.
constexpr bool needs_run(UnitState state) {
  return state == UnitState::missing || state == UnitState::waiting;
}

/// What the files of one unit tell.
struct UnitNotes {
  UnitState state = UnitState::missing;
  int tries = 0;  ///< the highest number of a try; 0: none
};

/// A process that runs a unit, as its file tells.
struct Runner {
  std::string host{};
  std::string system{};       ///< see this_system
  std::int64_t process = 0;   ///< number of the process in that system
  std::uint64_t started = 0;  ///< when that process was started, in ticks since the host was
  std::string job{};          ///< number of the job of a cluster; may be empty
  std::string log{};          ///< below the folder of the plan
  int signal = 0;             ///< that ended it, if somebody has seen it
};

std::string host_name();

/// What gives processes their numbers: a start of a machine, and a container of it. Names of hosts
/// need not differ.
std::string this_system();

/// This process. `log`: path below the folder of the plan.
Runner this_runner(std::string log);

class UnitFiles {
 public:
  explicit UnitFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path result_path(std::uint64_t unit) const;
  std::filesystem::path failure_path(std::uint64_t unit) const;
  std::filesystem::path try_path(std::uint64_t unit, int number) const;

  /// Notes of units [first, end), from one listing for each thousand.
  std::vector<UnitNotes> list(std::uint64_t first, std::uint64_t end) const;
  /// Notes of some units.
  std::vector<UnitNotes> list(const std::vector<std::uint64_t>& units) const;
  UnitNotes notes(std::uint64_t unit) const { return list({unit}).front(); }

  /// Begins to run a unit. Returns the number of the try; nothing if the unit needs no run or
  /// another process is running it. Of several processes only one succeeds.
  std::optional<int> begin(std::uint64_t unit, const Runner& runner) const;
  /// Keeps the result, or the failure, and removes the files of the tries.
  void finish(const UnitResult& result) const;
  /// The unit was stopped by the user: it counts as not run.
  void give_up(std::uint64_t unit, int number) const;
  /// Notes which signal ended the process that ran a unit.
  void note_signal(std::uint64_t unit, int number, int signal) const;
  /// Forgets the failure and the tries of a unit, so that it is run again. Throws IoError.
  void forget(std::uint64_t unit) const;

  /// `columns`: of its rows. Throw InputError, with what to do, for a damaged file.
  UnitResult read_result(std::uint64_t unit, std::size_t columns) const;
  UnitResult read_failure(std::uint64_t unit) const;
  std::optional<Runner> read_try(std::uint64_t unit, int number) const;

 private:
  class Clock;
  struct Found;

  std::filesystem::path stem(std::uint64_t unit) const;
  Found find(std::uint64_t unit) const;
  UnitNotes notes_of(std::uint64_t unit, const Found& found, Clock& clock) const;
  bool is_alive(std::uint64_t unit, int number, Clock& clock) const;
  void remove_tries(std::uint64_t unit) const;

  std::filesystem::path folder_;
};

}  // namespace springlod::sweep
