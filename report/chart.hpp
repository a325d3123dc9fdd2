#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/choice.hpp"

namespace springlod::report {

struct ChartPoint {
  double x = 0;
  double y = 0;
  std::string label;  ///< written beside the point; may be empty
  double y_low = 0;   ///< interval drawn if y_high > y_low
  double y_high = 0;
  double x_low = 0;  ///< likewise
  double x_high = 0;

  bool has_x_interval() const { return x_high > x_low; }
  bool has_y_interval() const { return y_high > y_low; }
};

/// The filled ones in the order in which series take them, then a ring around other points, larger,
/// and no symbol at all.
enum class ChartSymbol { disc, square, triangle, diamond, triangle_down, pentagon, ring, none };

inline constexpr Choice<ChartSymbol> kChartSymbols[] = {
    {ChartSymbol::disc, "disc", ""},
    {ChartSymbol::square, "square", ""},
    {ChartSymbol::triangle, "triangle", ""},
    {ChartSymbol::diamond, "diamond", ""},
    {ChartSymbol::triangle_down, "triangle_down", ""},
    {ChartSymbol::pentagon, "pentagon", ""},
    {ChartSymbol::ring, "ring", "goes around other points"},
    {ChartSymbol::none, "none", ""}};
constexpr ChoiceTable<Choice<ChartSymbol>> choices(ChartSymbol) {
  return {"symbol", kChartSymbols};
}

/// In the order in which series take them; black is for those that ask for it.
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
  std::vector<ChartPoint> points;  ///< none: the series is in the legend alone
  bool joined = true;
  bool dashed = false;                     ///< the line that joins them
  std::optional<ChartColour> colour = {};  ///< by default another for each series
  std::optional<ChartSymbol> symbol = {};  ///< likewise
};

struct ChartOptions {
  std::string title;
  std::string x_label;
  std::string y_label;
  bool log_x = false;
  bool log_y = false;
  double y_from = 0;   ///< points of a log axis that are not above it sit on its lower end, hollow
  double width = 900;  ///< [px]
  double height = 600;
};

struct ChartFiles {
  std::filesystem::path data;    ///< CSV beside the picture
  std::filesystem::path script;  ///< gnuplot script that draws it again
  bool drawn = false;            ///< false: gnuplot is not installed
  std::string command;           ///< that draws it
};

/// Draws through gnuplot as `path` (.svg or .png) and keeps script and data beside it.
/// Throws IoError, InputError (no points; not .svg or .png).
ChartFiles draw_chart(const std::vector<ChartSeries>& series, const ChartOptions& options,
                      const std::filesystem::path& path);

}  // namespace springlod::report
