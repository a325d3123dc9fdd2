// The state and the results of planned sweeps.

#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "base/progress.hpp"
#include "scripting/bind/sweep/sweep_program.hpp"
#include "scripting/bind/sweep/sweep_value.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "sweep/plan.hpp"
#include "sweep/status.hpp"

namespace springlod::scripting {

namespace {

namespace fs = std::filesystem;
using sweep::Plan;
using sweep::UnitFiles;
using sweep::UnitState;

constexpr const char* kGroup = "Sweeps";

int plan_of_binding(Call& call) {
  const Plan plan = sweep::read_plan(call.readable(1));
  lua_State* L = call.lua();
  begin_table(L);
  set_field(L, "script", plan.script);
  set_field(L, "arguments", plan.arguments);
  set_field(L, "folder", plan.folder);
  set_field(L, "seed", plan.seed);
  set_field(L, "portable", plan.portable);
  set_field(L, "units", plan.unit_count());
  set_field(L, "tasks", plan.tasks.size());
  set_field(L, "seconds", plan.total_cost() * plan.seconds_per_cost);
  return 1;
}

int status_binding(Call& call) {
  const fs::path folder = call.readable(1);
  const Plan plan = sweep::read_plan(folder);
  const sweep::Status status = sweep::status_of(plan, UnitFiles(folder));
  lua_State* L = call.lua();
  begin_table(L);
  set_field(L, "units", status.units);
  set_field(L, "done", status.done);
  set_field(L, "running", status.running);
  set_field(L, "failed", status.failed);
  set_field(L, "lost", status.lost);
  set_field(L, "missing", status.missing);
  set_field(L, "seconds_left", status.seconds_left);
  return 1;
}

/// Why a unit has no result.
struct Gap {
  std::string state, message, host, log;
  int signal = 0;
};

Gap gap_of(const UnitFiles& files, std::uint64_t unit, const sweep::UnitNotes& notes) {
  if (notes.state == UnitState::failed) {
    const sweep::UnitResult failure = files.read_failure(unit);
    return {"failed", failure.failure, failure.host, failure.log, failure.signal};
  }
  if (notes.state == UnitState::missing) return {"missing", "not run", "", "", 0};
  if (notes.state == UnitState::running) return {"running", "still running", "", "", 0};
  const auto runner = files.read_try(unit, notes.tries).value_or(sweep::Runner{});
  const std::string word = notes.state == UnitState::lost ? "lost" : "waiting";
  return {word, fmt::format("ended with its process, tries: {}", notes.tries), runner.host,
          runner.log, runner.signal};
}

void set_point(lua_State* L, const SweepValue& value, std::uint64_t unit) {
  set_field(L, "unit", unit + 1);
  set_axes(L, place_of(value, unit));
}

void set_gap(lua_State* L, const Gap& gap) {
  set_field(L, "state", gap.state);
  set_field(L, "message", gap.message);
  set_field(L, "host", gap.host);
  set_field(L, "signal", gap.signal);
  set_field(L, "log", gap.log);
}

void set_run(lua_State* L, const sweep::UnitResult& result) {
  set_field(L, "seconds", result.seconds);
  set_field(L, "memory", result.memory);
  set_field(L, "host", result.host);
  set_field(L, "target", result.target);
  set_field(L, "blas", result.blas);
  set_field(L, "springlod", result.version);
}

/// Appends the table on top to the list at `list`.
void append(lua_State* L, int list) {
  lua_rawseti(L, list, static_cast<lua_Integer>(lua_rawlen(L, list)) + 1);
}

/// Reads the results of the units [first, end) into three lists.
class Merging {
 public:
  Merging(lua_State* L, const SweepValue& value, const UnitFiles& files, Progress* progress)
      : lua_(L), value_(value), files_(files), progress_(progress) {
    for (int* list : {&rows_, &gaps_, &runs_}) {
      lua_newtable(L);
      *list = lua_gettop(L);
    }
  }
  void read(std::uint64_t first, std::uint64_t end) {
    Task task(progress_, "merging", end - first);
    const std::vector<sweep::UnitNotes> notes = files_.list(first, end);
    for (std::uint64_t unit = first; unit < end; ++unit) {
      const sweep::UnitNotes& note = notes[unit - first];
      try {
        if (note.state == UnitState::done)
          add_result(unit);
        else
          add_gap(unit, gap_of(files_, unit, note));
      } catch (const InputError& damage) {  // after the loss of power or a fault of the disk
        add_gap(unit, {"damaged", damage.what(), "", "", 0});
      }
      task.advance();
    }
  }
  void push() const {
    begin_table(lua_);
    for (const auto& [name, list] : {std::pair{"rows", rows_}, {"gaps", gaps_}, {"runs", runs_}}) {
      lua_pushvalue(lua_, list);
      end_field(lua_, name);
    }
  }

 private:
  void add_result(std::uint64_t unit) {
    const std::vector<std::string>& columns = place_of(value_, unit).stage.columns;
    const sweep::UnitResult result = files_.read_result(unit, columns.size());
    for (const sweep::Row& row : result.rows) {
      begin_table(lua_);
      set_point(lua_, value_, unit);
      set_cells(lua_, columns, row);
      append(lua_, rows_);
    }
    begin_table(lua_);
    set_field(lua_, "unit", unit + 1);
    set_run(lua_, result);
    append(lua_, runs_);
  }
  void add_gap(std::uint64_t unit, const Gap& gap) {
    begin_table(lua_);
    set_point(lua_, value_, unit);
    set_gap(lua_, gap);
    append(lua_, gaps_);
  }

  lua_State* lua_;
  const SweepValue& value_;
  const UnitFiles& files_;
  Progress* progress_;
  int rows_ = 0, gaps_ = 0, runs_ = 0;
};

int results_binding(Call& call) {
  const auto value = call.value<SweepValue>(1);
  const UnitFiles files(call.readable(2));
  const Plan plan = sweep::read_plan(files.folder());
  std::uint64_t stage = plan.stages.size();
  TableReader options = call.options(3);
  options.read("stage", stage);
  options.finish();
  if (stage < 1 || stage > plan.stages.size())
    options.refuse("stage", fmt::format("1 to {}", plan.stages.size()));
  const std::uint64_t first = plan.first_unit(stage - 1);
  lua_State* L = call.lua();
  Merging merging(L, *value, files, call.progress());
  merging.read(first, first + plan.stages[stage - 1].units);
  merging.push();
  return 1;
}

int forget_binding(Call& call) {
  const UnitFiles files(call.writable(1));
  const Plan plan = sweep::read_plan(files.folder());
  const std::vector<sweep::UnitNotes> notes = files.list(0, plan.unit_count());
  std::uint64_t count = 0;
  for (std::uint64_t unit = 0; unit < notes.size(); ++unit) {
    const UnitState state = notes[unit].state;
    if (state != UnitState::failed && state != UnitState::lost) continue;
    files.forget(unit);
    ++count;
  }
  return call.give(count);
}

int remove_binding(Call& call) {
  sweep::remove_plan(call.writable(1));
  return 0;
}

}  // namespace

void describe_sweep_results(Api& api) {
  api.add(FunctionEntry{
      .name = "sweep_plan",
      .group = kGroup,
      .summary = "What the plan in a folder says.",
      .arguments = {sweep_folder_argument()},
      .returns = "table: script, arguments, folder (in which the script ran), seed, portable, "
                 "units, tasks, seconds",
      .errors = "There is no plan, or it is damaged.",
      .example = "print(s.sweep_plan(\"out/drops\").units)",
      .call = plan_of_binding});
  api.add(FunctionEntry{
      .name = "sweep_status",
      .group = kGroup,
      .summary = "Counts the units of a plan by their state.",
      .arguments = {sweep_folder_argument()},
      .returns = "table: units, done, running, failed (by themselves), lost (with their process, "
                 "three times), missing, seconds_left (of one core, estimated)",
      .errors = "There is no plan, or it is damaged.",
      .example = "print(s.sweep_status(\"out/drops\").missing)",
      .call = status_binding});
  api.add(FunctionEntry{
      .name = "sweep_results",
      .group = kGroup,
      .summary = "Reads the results of a stage, by number of their units.",
      .arguments = {sweep_argument(), sweep_folder_argument()},
      .options = {{.name = "stage",
                   .type = "integer",
                   .fallback = "the last",
                   .help = "number of the stage, from 1"}},
      .returns = "table: rows (unit, the axes and the columns), gaps (unit, the axes, state, "
                 "message, host, signal and log of units without a result) and runs (unit, "
                 "seconds, memory, host, target, blas and springlod of the others)",
      .errors = "There is no plan, or it is damaged.",
      .example = "local results = s.sweep_results(sweep, \"out/drops\")",
      .call = results_binding});
  api.add(FunctionEntry{.name = "forget_failures",
                        .group = kGroup,
                        .summary = "Lets units that failed or were lost run again.",
                        .arguments = {sweep_folder_argument()},
                        .returns = "integer: how many there were",
                        .errors = "There is no plan, or it is damaged.",
                        .example = "s.forget_failures(\"out/drops\")",
                        .call = forget_binding});
  api.add(FunctionEntry{.name = "remove_sweep",
                        .group = kGroup,
                        .summary = "Removes the plan, the results of units and the logs of a "
                                   "sweep. What was merged stays.",
                        .arguments = {sweep_folder_argument()},
                        .returns = "nothing",
                        .errors = "There is no plan, or it is damaged.",
                        .example = "s.remove_sweep(\"out/drops\")",
                        .call = remove_binding});
}

}  // namespace springlod::scripting
