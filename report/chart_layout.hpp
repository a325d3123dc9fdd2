#pragma once

#include <string>
#include <vector>

#include "report/chart.hpp"

namespace springlod::report {

/// Size of a chart and position of its plot box [px], y downwards.
struct ChartFrame {
  double width = 900;
  double height = 600;
  double left = 96;
  double right = 876;
  double top = 90;
  double bottom = 522;
  double font = 15;  ///< font size [px]
};

struct Tick {
  double value = 0;
  std::string text;
};

/// Range, scale and ticks of an axis.
struct Axis {
  double low = 0;
  double high = 1;
  bool log = false;
  std::vector<Tick> ticks;
  /// Position along the axis: 0 at `low`, 1 at `high`; 0 for values below a log axis.
  double place(double value) const;
};

/// An axis that contains `values` with margins, and round ticks. Log axes ignore values that are
/// not above 0.
Axis make_axis(const std::vector<double>& values, bool log);

/// Text of a tick of a linear axis: "0.05", "20000", "2·10⁹".
std::string tick_text(double value);

/// Text of a tick of a log axis, in all charts: "0.01", "1", "500", beyond these "10⁻³", "2·10⁴".
std::string power_text(double value);

enum class TextAnchor { left, center, right };

/// The placed label of a point. Coordinates are in units of the plot box, 0..1 from the lower left.
struct PlacedLabel {
  std::string text;
  double x = 0;
  double y = 0;
  TextAnchor anchor = TextAnchor::left;
  std::size_t series = 0;
  bool led = false;  ///< away from its point, joined to it by a thin line
  double point_x = 0;
  double point_y = 0;
};

/// Places every label beside its point where it overlaps other labels, points and lines least. In
/// crowded regions labels move away from their points.
std::vector<PlacedLabel> place_labels(const std::vector<ChartSeries>& series, const Axis& x_axis,
                                      const Axis& y_axis, const ChartFrame& frame);

/// Font size of point labels, relative to the font size of the chart.
constexpr double kLabelFont = 0.9;

/// Approximate width of a text in a sans-serif font [px].
double text_width(const std::string& text, double font_size);

}  // namespace springlod::report
