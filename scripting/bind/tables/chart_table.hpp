#pragma once

#include <memory>
#include <vector>

#include "report/chart.hpp"
#include "report/csv.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/engine/call.hpp"

namespace springlod::scripting {

/// A series for each comparison, with one point for each level: cost per simulated second, relative
/// to the base, against error in percent of the base's bounding diagonal. The option `error` of
/// `reader` selects the error.
std::vector<report::ChartSeries> cost_error_series(
    const std::vector<std::shared_ptr<const ComparisonValue>>& comparisons, TableReader& reader);
report::ChartOptions cost_error_chart(const ComparisonValue& comparison);

/// {{name = ..., points = {{x, y}, ...}}, ...} at `index`; {series = {...}} is accepted too.
std::vector<report::ChartSeries> series_from_table(Call& call, int index);
void read_chart_options(const Call& call, TableReader& reader, report::ChartOptions& options);
std::vector<Parameter> chart_parameters();
/// The records Series and Point.
void describe_series(Api& api);

/// A list of rows, each a table with the columns as keys; an empty string for a missing value.
void push_rows(lua_State* L, const report::Table& table);

/// Rows at `index` with the option `columns`.
report::Table table_from_rows(Call& call, int index, TableReader& reader);

}  // namespace springlod::scripting
