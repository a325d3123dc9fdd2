#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace springlod {

struct ChartPoint {
  double x = 0;
  double y = 0;
  std::string label;  ///< written beside the point; may be empty
  double y_low = 0;   ///< interval drawn if y_high > y_low
  double y_high = 0;
};

struct ChartSeries {
  std::string name;
  std::vector<ChartPoint> points;
  bool joined = true;
};

struct ChartOptions {
  std::string title;
  std::string x_label;
  std::string y_label;
  bool log_x = false;
  bool log_y = false;
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

}  // namespace springlod
