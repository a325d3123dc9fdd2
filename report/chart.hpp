#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "base/choice.hpp"
#include "base/option.hpp"

namespace springlod::report {

struct ChartPoint {
  double x = 0;
  double y = 0;
  std::string label;  ///< written beside the point; may be empty
  double y_low = 0;   ///< interval drawn if y_high > y_low
  double y_high = 0;
  double x_low = 0;  ///< interval drawn if x_high > x_low
  double x_high = 0;

  bool has_x_interval() const { return x_high > x_low; }
  bool has_y_interval() const { return y_high > y_low; }
};
constexpr auto option_rows(const ChartPoint*) {
  return std::tuple(
      option("label", &ChartPoint::label, "text beside the point").within(0, kLongestTitle),
      option("low", &ChartPoint::y_low, "lower end of an interval drawn about y")
          .by_default("none"),
      option("high", &ChartPoint::y_high, "upper end of that interval").by_default("none"),
      option("x_low", &ChartPoint::x_low, "lower end of an interval drawn about x")
          .by_default("none"),
      option("x_high", &ChartPoint::x_high, "upper end of that interval").by_default("none"));
}

/// Filled symbols in the default order of series; then a larger ring that marks other points, and
/// no symbol.
enum class ChartSymbol { disc, square, triangle, diamond, triangle_down, pentagon, ring, none };

inline constexpr Choice<ChartSymbol> kChartSymbols[] = {
    {ChartSymbol::disc, "disc", ""},
    {ChartSymbol::square, "square", ""},
    {ChartSymbol::triangle, "triangle", ""},
    {ChartSymbol::diamond, "diamond", ""},
    {ChartSymbol::triangle_down, "triangle_down", ""},
    {ChartSymbol::pentagon, "pentagon", ""},
    {ChartSymbol::ring, "ring", "larger ring that marks other points"},
    {ChartSymbol::none, "none", ""}};
constexpr ChoiceTable<Choice<ChartSymbol>> choices(ChartSymbol) {
  return {"symbol", kChartSymbols};
}

/// In the default order of series; black is used only if a series sets it.
enum class ChartColour { blue, orange, green, pink, amber, sky, grey, black };

inline constexpr Choice<ChartColour> kChartColours[] = {
    {ChartColour::blue, "blue", ""},   {ChartColour::orange, "orange", ""},
    {ChartColour::green, "green", ""}, {ChartColour::pink, "pink", ""},
    {ChartColour::amber, "amber", ""}, {ChartColour::sky, "sky", ""},
    {ChartColour::grey, "grey", ""},   {ChartColour::black, "black", ""}};
constexpr ChoiceTable<Choice<ChartColour>> choices(ChartColour) {
  return {"colour", kChartColours};
}

struct ChartSeries {
  std::string name;
  std::vector<ChartPoint> points;  ///< none: the series appears only in the legend
  bool joined = true;
  bool dashed = false;                     ///< style of the line between the points
  std::optional<ChartColour> colour = {};  ///< default: a different one for each series
  std::optional<ChartSymbol> symbol = {};  ///< default: a different one for each series
};
constexpr auto option_rows(const ChartSeries*) {
  return std::tuple(
      option("name", &ChartSeries::name, "name in the legend").within(0, kLongestTitle),
      option("joined", &ChartSeries::joined, "whether a line joins the points"),
      option("dashed", &ChartSeries::dashed, "whether the line is dashed"),
      option("colour", &ChartSeries::colour, "colour of points and line")
          .by_default("a different one for each series"),
      option("symbol", &ChartSeries::symbol, "symbol of the points")
          .by_default("a different one for each series"));
}

struct ChartOptions {
  std::string title;
  std::string x_label;
  std::string y_label;
  bool log_x = false;
  bool log_y = false;
  double y_from = 0;   ///< lower end of a log axis; points at or below it are drawn there, hollow
  double width = 900;  ///< [px]
  double height = 600;
};
/// Limits of a chart's sides [px]: its text must fit, and other programs must be able to show it.
inline constexpr double kLeastSide = 300;
inline constexpr double kLargestSide = 8000;

constexpr auto option_rows(const ChartOptions*) {
  return std::tuple(
      option("title", &ChartOptions::title, "title")
          .within(0, kLongestTitle)
          .by_default("the scenario's name, else none"),
      option("x_label", &ChartOptions::x_label, "label of the horizontal axis")
          .within(0, kLongestTitle)
          .by_default("taken from comparisons and runs, else none"),
      option("y_label", &ChartOptions::y_label, "label of the vertical axis")
          .within(0, kLongestTitle)
          .by_default("taken from comparisons and runs, else none"),
      option("log_x", &ChartOptions::log_x, "whether the horizontal axis is logarithmic")
          .by_default("true for a comparison, else false"),
      option("log_y", &ChartOptions::log_y, "whether the vertical axis is logarithmic"),
      option("y_from", &ChartOptions::y_from,
             "lower end of a logarithmic y axis; lower points are drawn there, hollow"),
      option("width", &ChartOptions::width, "width in pixels").within(kLeastSide, kLargestSide),
      option("height", &ChartOptions::height, "height in pixels").within(kLeastSide, kLargestSide));
}

struct ChartFiles {
  std::filesystem::path data;    ///< CSV file beside the chart
  std::filesystem::path script;  ///< gnuplot script that draws the chart
  bool drawn = false;            ///< false: gnuplot is not installed
  std::string command;           ///< command that runs the script
};

/// Draws a chart with gnuplot to `path` (.svg or .png); script and data are kept beside it. Throws
/// IoError and InputError (no points; not .svg or .png).
ChartFiles draw_chart(const std::vector<ChartSeries>& series, const ChartOptions& options,
                      const std::filesystem::path& path);

}  // namespace springlod::report
