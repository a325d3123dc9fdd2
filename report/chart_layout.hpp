#pragma once

#include <string>
#include <vector>

#include "report/chart.hpp"

namespace springlod::report {

/// Size of a chart and place of its plot box [px], y downwards.
struct ChartFrame {
  double width = 900;
  double height = 600;
  double left = 96;
  double right = 876;
  double top = 90;
  double bottom = 522;
  double font = 15;  ///< size of the letters
};

struct Tick {
  double value = 0;
  std::string text;
};

/// What an axis shows.
struct Axis {
  double low = 0;
  double high = 1;
  bool log = false;
  std::vector<Tick> ticks;
  /// Place along the axis, 0 at `low`, 1 at `high`; a value below a log axis is at 0.
  double place(double value) const;
};

/// Range with some room around `values` and round ticks. A log axis ignores values that are not
/// above 0.
Axis make_axis(const std::vector<double>& values, bool log);

/// "0.05", "2·10⁹"
std::string tick_text(double value);

/// "1", "10", "10³", "2·10⁴": short for powers of ten.
std::string power_text(double value);

enum class TextAnchor { left, center, right };

/// A point's label, placed: anchor in plot box units, 0..1 from the lower left.
struct PlacedLabel {
  std::string text;
  double x = 0;
  double y = 0;
  TextAnchor anchor = TextAnchor::left;
  std::size_t series = 0;
  bool led = false;  ///< away from its point, to which a thin line leads
  double point_x = 0;
  double point_y = 0;
};

/// Puts every label beside its point where it hides least: other labels, points and lines. In a
/// crowd it goes some way off.
std::vector<PlacedLabel> place_labels(const std::vector<ChartSeries>& series, const Axis& x_axis,
                                      const Axis& y_axis, const ChartFrame& frame);

/// Size of point labels, as a part of the chart's letters.
constexpr double kLabelFont = 0.9;

/// Rough width of a text in a sans-serif font [px].
double text_width(const std::string& text, double font_size);

}  // namespace springlod::report
