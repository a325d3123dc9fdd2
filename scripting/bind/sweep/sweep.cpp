// Sweeps: many independent computations, described by a script.

#include <map>
#include <memory>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "scripting/bind/sweep/sweep_value.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "scripting/engine/result_table.hpp"

namespace springlod::scripting {

namespace {

constexpr const char* kGroup = "Sweeps";
/// Units of a sweep: more files than a file system holds with pleasure.
constexpr std::uint64_t kMostUnits = 10'000'000;
constexpr const char* kReserved[] = {"", "index", "seed", "folder", "unit", "missing"};
/// Columns that follow the axes in gaps.csv.
constexpr const char* kGapColumns[] = {"state", "message", "host", "signal", "log"};

FunctionReference keep_function(TableReader& reader, const char* name) {
  const int index = reader.raw(name);
  if (index == 0) return 0;
  lua_State* L = reader.lua();
  if (!lua_isfunction(L, index)) reader.refuse(name, "a function");
  lua_pushvalue(L, index);
  return luaL_ref(L, LUA_REGISTRYINDEX);
}

sweep::Cell axis_value(TableReader& reader, int index) {
  lua_State* L = reader.lua();
  if (lua_isinteger(L, index) != 0) return static_cast<std::int64_t>(lua_tointeger(L, index));
  if (lua_type(L, index) == LUA_TNUMBER) return lua_tonumber(L, index);
  if (lua_type(L, index) == LUA_TSTRING) return std::string(lua_tostring(L, index));
  if (lua_isboolean(L, index)) return lua_toboolean(L, index) != 0;
  reader.refuse("axes", fmt::format("lists of numbers, texts or booleans, not of {}",
                                    describe_type_at(L, index)));
}

/// {"young", {1e5, 1e6}} on top.
SweepAxis read_axis(TableReader& reader) {
  constexpr const char* kForm = "a list of axes such as {\"young\", {1e5, 1e6}}";
  lua_State* L = reader.lua();
  SweepAxis axis;
  if (!lua_istable(L, -1) || lua_geti(L, -1, 1) != LUA_TSTRING) reader.refuse("axes", kForm);
  axis.name = lua_tostring(L, -1);
  lua_pop(L, 1);
  if (lua_geti(L, -1, 2) != LUA_TTABLE) reader.refuse("axes", kForm);
  const lua_Integer count = luaL_len(L, -1);
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_geti(L, -1, i);
    axis.values.push_back(axis_value(reader, lua_gettop(L)));
    lua_pop(L, 1);
  }
  lua_pop(L, 1);
  if (axis.values.empty())
    reader.refuse("axes", fmt::format("axes with values; '{}' has none", axis.name));
  return axis;
}

void read_axes(TableReader& reader, SweepStage& stage) {
  const int given = reader.raw("axes");
  if (given == 0) return;
  lua_State* L = reader.lua();
  if (!lua_istable(L, given)) reader.refuse("axes", "a list of axes");
  const lua_Integer count = luaL_len(L, given);
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_geti(L, given, i);
    stage.axes.push_back(read_axis(reader));
    lua_pop(L, 1);
  }
  if (stage.axes.empty()) reader.refuse("axes", "a list of at least one axis");
}

void check_names(TableReader& reader, const SweepStage& stage) {
  std::set<std::string> names(std::begin(kReserved), std::end(kReserved));
  const auto add = [&](const char* option, const std::string& name) {
    if (!names.insert(name).second)
      reader.refuse(option, fmt::format("names of their own; '{}' has another meaning, or is there "
                                        "twice",
                                        name));
  };
  for (const std::string& column : stage.columns) add("columns", column);
  names.insert(std::begin(kGapColumns), std::end(kGapColumns));
  for (const SweepAxis& axis : stage.axes) add("axes", axis.name);
}

void count_units(TableReader& reader, SweepStage& stage) {
  std::optional<std::uint64_t> count;
  reader.read("count", count);
  if (count.has_value() == !stage.axes.empty())
    reader.refuse("count",
                  "given, or axes, but not both: the units are counted, or they are all "
                  "combinations of the values of the axes");
  stage.units = count.value_or(1);
  for (const SweepAxis& axis : stage.axes) {
    stage.units *= axis.values.size();
    if (stage.units > kMostUnits) break;
  }
  if (stage.units == 0 || stage.units > kMostUnits)
    reader.refuse(count ? "count" : "axes",
                  fmt::format("such that there are 1 to {} units", kMostUnits));
}

void read_stage(TableReader& reader, SweepStage& stage) {
  read_axes(reader, stage);
  count_units(reader, stage);
  reader.read("columns", stage.columns);
  check_names(reader, stage);
  stage.unit = keep_function(reader, "unit");
  if (stage.unit == 0) reader.refuse("unit", "a function of a point that returns its row");
  stage.cost = keep_function(reader, "cost");
  reader.read("timings", stage.timings);
  for (const std::string& name : stage.timings)
    if (std::find(stage.columns.begin(), stage.columns.end(), name) == stage.columns.end())
      reader.refuse("timings", fmt::format("names of columns; '{}' is none", name));
  reader.read("waits", stage.waits);
  reader.read("alone", stage.alone);
}

/// Units of a stage that runs alone have no others beside them.
void check_phases(TableReader& reader, const std::vector<SweepStage>& stages) {
  for (std::size_t i = 0; i < stages.size(); ++i) {
    if (i > 0 && !stages[i].waits && (stages[i].alone || stages[i - 1].alone))
      reader.refuse("stages", fmt::format("stages such that '{}' waits: it or the one before it "
                                          "runs alone",
                                          stages[i].name));
  }
}

int sweep_binding(Call& call) {
  auto value = std::make_shared<SweepValue>();
  TableReader reader = call.options(1);
  value->report = keep_function(reader, "report");
  const int stages = reader.raw("stages");
  if (stages == 0) {
    read_stage(reader, value->stages.emplace_back());
    value->stages.front().name = "units";
    reader.finish();
    return call.give(std::shared_ptr<const SweepValue>(std::move(value)));
  }
  for (const char* name : {"axes", "count", "columns", "unit", "cost", "timings", "waits", "alone"})
    if (reader.has(name)) reader.refuse(name, "inside the stages, if there are stages");
  lua_State* L = call.lua();
  if (!lua_istable(L, stages)) reader.refuse("stages", "a list of stages");
  const lua_Integer count = luaL_len(L, stages);
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_geti(L, stages, i);
    SweepStage& stage = value->stages.emplace_back();
    TableReader record =
        call.record(lua_gettop(L), "SweepStage", fmt::format("sweep: stage {}", i));
    stage.name = fmt::format("stage {}", i);
    record.read("name", stage.name);
    read_stage(record, stage);
    record.finish();
    lua_settop(L, stages);
  }
  if (value->stages.empty()) reader.refuse("stages", "a list of at least one stage");
  check_phases(reader, value->stages);
  reader.finish();
  return call.give(std::shared_ptr<const SweepValue>(std::move(value)));
}

std::uint64_t unit_argument(Call& call, const SweepValue& sweep) {
  return static_cast<std::uint64_t>(
             call.integer(1, 1, static_cast<long long>(sweep.unit_count()))) -
         1;
}

int point_method(Call& call) {
  const auto sweep = call.self<SweepValue>();
  push_point(call.lua(), {*sweep, unit_argument(call, *sweep)});
  return 1;
}

int run_method(Call& call) {
  const auto sweep = call.self<SweepValue>();
  const std::uint64_t unit = unit_argument(call, *sweep);
  const std::string folder = call.has(2) ? call.writable(2).string() : "";
  const std::vector<sweep::Row> rows = run_unit(call.lua(), {*sweep, unit, folder});
  const std::vector<std::string>& columns = place_of(*sweep, unit).stage.columns;
  push_tables(call.lua(), rows,
              [&](const sweep::Row& row) { set_cells(call.lua(), columns, row); });
  return 1;
}

void push_report(lua_State* L, const SweepValue& sweep) {
  if (sweep.report == 0)
    lua_pushnil(L);
  else
    lua_rawgeti(L, LUA_REGISTRYINDEX, sweep.report);
}

void push_stages(lua_State* L, const SweepValue& sweep) {
  push_tables(L, sweep.stages, [&](const SweepStage& stage) {
    set_field(L, "name", stage.name);
    set_field(L, "units", stage.units);
    set_field(L, "columns", stage.columns);
    set_field(L, "timings", stage.timings);
    set_field(L, "estimated", stage.cost != 0);
    std::vector<std::string> axes;
    for (const SweepAxis& axis : stage.axes) axes.push_back(axis.name);
    set_field(L, "axes", axes);
  });
}

std::string description(const SweepValue& sweep) {
  std::vector<std::string> parts;
  for (const SweepStage& stage : sweep.stages) {
    std::vector<std::string> axes;
    for (const SweepAxis& axis : stage.axes)
      axes.push_back(fmt::format("{} {}", axis.values.size(), axis.name));
    parts.push_back(
        fmt::format("{} {}{}", stage.units, stage.name,
                    axes.size() < 2 ? "" : fmt::format(" ({})", fmt::join(axes, " x "))));
  }
  return fmt::format("Sweep: {}", fmt::join(parts, ", then "));
}

void describe_type(Api& api) {
  TypeBuilder<SweepValue> type(
      "Many independent computations, its units. springlod sweep plans, runs and merges them.",
      description);
  type.field("units", "integer", "number of units of all stages",
             [](const SweepValue& sweep) { return sweep.unit_count(); });
  type.table_field(
      "stages", "list of tables",
      "name, units, axes (their names), columns, timings and estimated (whether it has "
      "a cost) "
      "of each stage",
      push_stages);
  type.table_field("report", "function or nil", "of the script, to be called with all results",
                   push_report);
  const Parameter unit{.name = "unit", .type = "integer", .help = "number of a unit, from 1"};
  type.method({.name = "point",
               .summary = "What the functions of the sweep are called with for a unit.",
               .arguments = {unit},
               .returns = "table: values of the axes by name, index in the stage, seed; in units "
                          "and costs also folder, that of the plan",
               .call = point_method});
  type.method({.name = "run",
               .summary = "Runs one unit here, to try it.",
               .arguments = {unit,
                             {.name = "folder",
                              .type = "string",
                              .fallback = "none",
                              .help = "for units that read or write files in the folder of the "
                                      "plan"}},
               .returns = "list of rows",
               .call = run_method});
  api.add(type.build());
}

std::vector<Parameter> stage_parameters() {
  return {
      {.name = "axes",
       .type = "list of axes",
       .fallback = "none",
       .help = "what varies: {name, list of values} each; the units are all combinations, the last "
               "axis varying fastest"},
      {.name = "count",
       .type = "integer",
       .fallback = "none",
       .help = "number of units, in place of axes"},
      {.name = "columns",
       .type = "list of strings",
       .fallback = "none",
       .help = "keys of the rows that unit returns"},
      {.name = "unit",
       .type = "function",
       .help = "unit(point) returns a row, a table of numbers, texts and booleans by column, or a "
               "list of rows, which may be empty. The result must depend on the point alone: units "
               "run in any order, on "
               "any machine"},
      {.name = "cost",
       .type = "function",
       .fallback = "all alike",
       .help = "cost(point) estimates the spring updates of a unit: springs * duration / stable "
               "step"},
      {.name = "timings",
       .type = "list of strings",
       .fallback = "none",
       .help = "those of the columns that are measured times: merge writes them to a file of "
               "their own, as they differ between two runs"},
      {.name = "waits",
       .type = "boolean",
       .fallback = "true",
       .help = "whether it begins when the stages before have ended, and may use what those have "
               "written; false: it begins with the stage before"},
      {.name = "alone",
       .type = "boolean",
       .fallback = "false",
       .help = "whether each unit has a machine to itself, because it measures times"},
  };
}

}  // namespace

void describe_sweep(Api& api) {
  describe_type(api);
  std::vector<Parameter> fields = stage_parameters();
  fields.insert(
      fields.begin(),
      {.name = "name", .type = "string", .fallback = "\"stage N\"", .help = "for messages"});
  api.add(RecordEntry{.name = "SweepStage",
                      .summary = "Units of a sweep that may run in any order.",
                      .fields = std::move(fields),
                      .example = "{name = \"drops\", axes = {{\"level\", {0, 1, 2}}},\n"
                                 " columns = {\"height\"}, unit = drop}"});
  std::vector<Parameter> options = stage_parameters();
  for (Parameter& option : options)
    if (option.name == "unit") option.fallback = "inside stages";
  options.push_back({.name = "stages",
                     .type = "list of SweepStage",
                     .fallback = "one, of the options above",
                     .help = "stages in their order"});
  options.push_back({.name = "report",
                     .type = "function",
                     .fallback = "none",
                     .help =
                         "report(results, folder) draws and writes what is made of all results, "
                         "the table that s.sweep_results returns"});
  api.add(FunctionEntry{
      .name = "sweep",
      .group = kGroup,
      .summary = "Describes many independent computations for springlod sweep, which runs them on "
                 "all cores or on a cluster. A script of a sweep returns its value.",
      .options = std::move(options),
      .returns = "Sweep",
      .errors = "An axis without values; a name that is used twice; no units, or too many.",
      .example = "return s.sweep{axes = {{\"height\", {0.1, 0.2}}}, columns = {\"contact_time\"},\n"
                 "  unit = function(point)\n"
                 "    local scene = s.scenario{duration = 1, lift = point.height}\n"
                 "    return {contact_time = s.run(chain, scene, {quiet = true}).first_contact}\n"
                 "  end}",
      .call = sweep_binding});
}

}  // namespace springlod::scripting
