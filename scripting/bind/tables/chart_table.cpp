#include "scripting/bind/tables/chart_table.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "report/run_chart.hpp"
#include "report/tables.hpp"
#include "scripting/bind/tables/labelled_runs.hpp"
#include "scripting/bind/tables/options.hpp"
#include "scripting/engine/quantity.hpp"

namespace springlod::scripting {

namespace {

enum class ErrorKind { surface, shape };

constexpr Choice<ErrorKind> kErrorKinds[] = {
    {ErrorKind::surface, "surface", "distance of the nodes from the base's"},
    {ErrorKind::shape, "shape", "the same after the best rigid fit"}};
constexpr ChoiceTable<Choice<ErrorKind>> choices(ErrorKind) {
  return {"error", kErrorKinds};
}

// {x, y, label = ..., low = ..., high = ..., x_low = ..., x_high = ...}
report::ChartPoint read_point(Call& call, int table, const std::string& owner) {
  lua_State* L = call.lua();
  if (!lua_istable(L, table) || lua_rawlen(L, table) != 2)
    throw InputError(fmt::format("{} must be {{x, y}}", owner));
  report::ChartPoint point;
  lua_rawgeti(L, table, 1);
  point.x = usual_quantity_at(L, -1, Dimension::number, owner + "[1]");
  lua_rawgeti(L, table, 2);
  point.y = usual_quantity_at(L, -1, Dimension::number, owner + "[2]");
  lua_pop(L, 2);
  lua_newtable(L);
  for_each_option(point, [&](const auto& row, const auto& /*usual*/) {
    lua_getfield(L, table, row.name);
    lua_setfield(L, -2, row.name);
  });
  TableReader reader = call.record(lua_gettop(L), "Point", owner);
  read_options(call, reader, point);
  reader.finish();
  lua_pop(L, 1);
  return point;
}

report::ChartSeries read_series(Call& call, int table, const std::string& owner) {
  lua_State* L = call.lua();
  TableReader reader = call.record(table, "Series", owner);
  report::ChartSeries series;
  read_options(call, reader, series);
  const int points = reader.raw("points");
  if (points == 0 || !lua_istable(L, points)) reader.refuse("points", "a list of {x, y}");
  for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(L, points)); ++i) {
    lua_rawgeti(L, points, i);
    series.points.push_back(
        read_point(call, lua_gettop(L), fmt::format("{}.points[{}]", owner, i)));
    lua_pop(L, 1);
  }
  reader.finish();
  lua_pop(L, 1);
  return series;
}

report::Cell read_cell(lua_State* L, int index) {
  switch (lua_type(L, index)) {
    case LUA_TNUMBER:
      if (lua_isinteger(L, index) != 0) return static_cast<std::int64_t>(lua_tointeger(L, index));
      return lua_tonumber(L, index);
    case LUA_TNIL:
      return {};
    default: {
      std::string text = luaL_tolstring(L, index, nullptr);
      lua_pop(L, 1);
      return text;
    }
  }
}

void push_cell(lua_State* L, const report::Cell& cell) {
  if (const auto* whole = std::get_if<std::int64_t>(&cell))
    lua_pushinteger(L, *whole);
  else if (const auto* number = std::get_if<double>(&cell))
    lua_pushnumber(L, *number);
  else if (const auto* text = std::get_if<std::string>(&cell))
    push(L, *text);
  else
    push(L, std::string());
}

std::vector<std::string> sorted_keys(lua_State* L, int table) {
  std::vector<std::string> keys;
  lua_pushnil(L);
  while (lua_next(L, table) != 0) {
    if (lua_type(L, -2) == LUA_TSTRING) keys.emplace_back(lua_tostring(L, -2));
    lua_pop(L, 1);
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

}  // namespace

namespace {

report::ChartSeries series_of(const ComparisonValue& comparison, ErrorKind kind) {
  const report::Table table =
      report::comparison_table(comparison.comparison, comparison.chain->chain);
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::find(table.columns.begin(), table.columns.end(), name) -
                                    table.columns.begin());
  };
  const std::size_t ratio = column("cost_ratio");
  const std::size_t error =
      column(kind == ErrorKind::surface ? "surface_error_percent" : "shape_error_percent");
  report::ChartSeries series;
  // The title names the scenario; the legend names the merging method.
  series.name = comparison.chain->chain.levels.back().made_by;
  for (const auto& row : table.rows)
    series.points.push_back({.x = 1 / std::get<double>(row[ratio]),
                             .y = std::get<double>(row[error]),
                             .label = std::get<std::string>(row[column("label")])});
  return series;
}

/// The variant of a comparison, by which its labels begin ("hb level 1"), or its number.
std::string name_of(const ComparisonValue& comparison, std::size_t number) {
  const std::string& label = comparison.comparison.levels.back().label;
  const std::size_t end = label.rfind(" level ");
  return end == std::string::npos ? fmt::format("comparison {}", number) : label.substr(0, end);
}

}  // namespace

std::vector<report::ChartSeries> cost_error_series(
    const std::vector<std::shared_ptr<const ComparisonValue>>& comparisons, TableReader& reader) {
  ErrorKind kind = ErrorKind::surface;
  reader.read("error", kind);
  std::vector<report::ChartSeries> all;
  for (const auto& comparison : comparisons) {
    all.push_back(series_of(*comparison, kind));
    if (comparisons.size() == 1) break;
    all.back().name = fmt::format("{}: {}", name_of(*comparison, all.size()), all.back().name);
    if (all.size() > 1) all.back().points.front().label.clear();  // all bases are at 1
  }
  return all;
}

report::ChartOptions cost_error_chart(const ComparisonValue& comparison) {
  return {.title = comparison.comparison.scenario.name,
          .x_label = "cost per simulated second (spring updates, base = 1)",
          .y_label = "error (% of the bounding diagonal)",
          .log_x = true};
}

std::vector<report::ChartSeries> series_from_table(Call& call, int index) {
  lua_State* L = call.lua();
  if (!lua_istable(L, index))
    call.refuse(2,
                "a Comparison, a Trajectory, a list of either, a StabilityMap or a list of Series");
  std::vector<report::ChartSeries> series;
  for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(L, index)); ++i) {
    lua_rawgeti(L, index, i);
    series.push_back(read_series(call, lua_gettop(L), fmt::format("chart: series[{}]", i)));
    lua_pop(L, 1);
  }
  return series;
}

void read_chart_options(const Call& call, TableReader& reader, report::ChartOptions& options) {
  read_options(call, reader, options);
  reader.has("error");  // read for comparisons only
}

std::vector<Parameter> chart_parameters() {
  std::vector<Parameter> parameters = parameters_of<report::ChartOptions>();
  parameters.push_back({.name = "error",
                        .type = "one of",
                        .fallback = "\"surface\"",
                        .help = "error shown for a comparison",
                        .choices = words_of<ErrorKind>()});
  parameters.push_back({.name = "quantity",
                        .type = "one of",
                        .fallback = "\"height\"",
                        .help = "what a chart of Trajectories shows over time",
                        .choices = words_of<report::RunQuantity>()});
  parameters.push_back(labels_parameter());
  return parameters;
}

void describe_series(Api& api) {
  api.add(RecordEntry{.name = "Point",
                      .summary = "A point of a chart: {x, y}, with these keys if needed.",
                      .fields = parameters_of<report::ChartPoint>(),
                      .example = "{0.4, 1.2, label = \"level 1\"}"});
  std::vector<Parameter> fields = parameters_of<report::ChartSeries>();
  fields.push_back({.name = "points",
                    .type = "list of Point",
                    .help = "points {x, y}; if empty, the series appears only in the legend"});
  api.add(RecordEntry{.name = "Series",
                      .summary = "A line of points of a chart.",
                      .fields = std::move(fields),
                      .example = "{name = \"y = x^2\", points = {{1, 1}, {2, 4}}}"});
}

report::Table table_from_rows(Call& call, int index, TableReader& reader) {
  lua_State* L = call.lua();
  if (!lua_istable(L, index)) throw InputError(reader.owner() + ": rows must be a list of tables");
  report::Table table;
  reader.read("columns", table.columns);
  const auto count = static_cast<lua_Integer>(lua_rawlen(L, index));
  for (lua_Integer i = 1; i <= count; ++i) {
    if (lua_rawgeti(L, index, i) != LUA_TTABLE)
      throw InputError(fmt::format("{}: row {} is not a table", reader.owner(), i));
    const int row = lua_gettop(L);
    if (table.columns.empty()) table.columns = sorted_keys(L, row);
    const bool list = lua_rawlen(L, row) > 0;
    const std::size_t cells = list ? lua_rawlen(L, row) : table.columns.size();
    std::vector<report::Cell>& row_cells = table.rows.emplace_back();
    for (std::size_t c = 0; c < cells; ++c) {
      if (list) {
        lua_rawgeti(L, row, static_cast<lua_Integer>(c) + 1);
      } else {
        lua_getfield(L, row, table.columns[c].c_str());
      }
      row_cells.push_back(read_cell(L, -1));
      lua_pop(L, 1);
    }
    lua_pop(L, 1);
  }
  return table;
}

void push_rows(lua_State* L, const report::Table& table) {
  begin_list(L, table.rows.size());
  std::size_t number = 0;
  for (const auto& row : table.rows) {
    begin_table(L);
    for (std::size_t i = 0; i < row.size(); ++i) {
      push_cell(L, row[i]);
      end_field(L, table.columns[i].c_str());
    }
    end_list_entry(L, ++number);
  }
}

}  // namespace springlod::scripting
