#include "report/chart_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace springlod::report {
namespace {

constexpr double kRoom = 0.07;  // margin at the ends of an axis, as a fraction of its length

std::string superscript(int number) {
  static constexpr std::array<const char*, 10> kDigits{"⁰", "¹", "²", "³", "⁴",
                                                       "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out;
  for (const char c : fmt::format("{}", number))
    out += c == '-' ? "⁻" : kDigits[static_cast<std::size_t>(c - '0')];
  return out;
}

// Largest of 1, 2 and 5 times a power of ten that is at most `wanted`.
double round_step(double wanted) {
  const double power = std::pow(10., std::floor(std::log10(wanted)));
  for (const double factor : {5., 2.})
    if (factor * power <= wanted) return factor * power;
  return power;
}

std::vector<Tick> linear_ticks(double low, double high, std::string (*text)(double)) {
  constexpr double kWanted = 6;
  const double step = round_step((high - low) / kWanted * 1.5);
  std::vector<Tick> ticks;
  constexpr double kSlack = 1e-9;  // includes ticks at the end despite rounding errors
  const auto first = static_cast<long long>(std::ceil(low / step - kSlack));
  const auto last = static_cast<long long>(std::floor(high / step + kSlack));
  for (long long i = first; i <= last; ++i) {
    const double value = static_cast<double>(i) * step;
    ticks.push_back({value, text(value)});
  }
  return ticks;
}

std::vector<Tick> log_ticks(double low, double high) {
  const double decades = std::log10(high / low);
  // Ticks of a log axis: linear steps for less than half a decade, every digit up to one decade,
  // 1, 2 and 5 up to three, and at most about 8 whole decades beyond.
  constexpr double kHalfDecade = 0.5;
  if (decades < kHalfDecade) return linear_ticks(low, high, power_text);
  constexpr double kOneDecade = 1;
  constexpr double kNarrow = 3;
  const int stride = std::max(1, static_cast<int>(std::ceil(decades / 8)));
  std::vector<Tick> ticks;
  for (int e = static_cast<int>(std::floor(std::log10(low))); std::pow(10., e) <= high; ++e) {
    for (int digit = 1; digit <= 9; ++digit) {
      const double value = digit * std::pow(10., e);
      const bool wanted = digit == 1                 ? decades <= kNarrow || e % stride == 0
                          : digit == 2 || digit == 5 ? decades <= kNarrow
                                                     : decades <= kOneDecade;
      if (wanted && value >= low * (1 - 1e-9) && value <= high * (1 + 1e-9))
        ticks.push_back({value, power_text(value)});
    }
  }
  return ticks;
}

struct Box {
  double x0, y0, x1, y1;
  double weight = 1;  ///< cost of hiding it, per unit of area
};

double overlap(const Box& a, const Box& b) {
  const double w = std::min(a.x1, b.x1) - std::max(a.x0, b.x0);
  const double h = std::min(a.y1, b.y1) - std::max(a.y0, b.y0);
  return w > 0 && h > 0 ? w * h : 0;
}

// Boxes that labels should avoid: markers, and lines as chains of small boxes.
std::vector<Box> obstacles(const std::vector<ChartSeries>& series, const Axis& x_axis,
                           const Axis& y_axis, const ChartFrame& frame) {
  constexpr double kMarker = 6;
  constexpr double kLine = 2;
  constexpr double kHiddenMarker = 3;
  constexpr double kHiddenInterval = 0.3;  // weight of intervals, whose ends remain visible
  constexpr double kEvery = 8;
  std::vector<Box> boxes;
  const auto px = [&](const ChartPoint& p) {
    return frame.left + x_axis.place(p.x) * (frame.right - frame.left);
  };
  const auto py = [&](const ChartPoint& p) {
    return frame.bottom - y_axis.place(p.y) * (frame.bottom - frame.top);
  };
  for (const ChartSeries& s : series)
    for (std::size_t i = 0; i < s.points.size(); ++i) {
      const double x = px(s.points[i]);
      const double y = py(s.points[i]);
      boxes.push_back({x - kMarker, y - kMarker, x + kMarker, y + kMarker, kHiddenMarker});
      if (s.points[i].has_x_interval()) {
        const double width = frame.right - frame.left;
        boxes.push_back({frame.left + x_axis.place(s.points[i].x_low) * width, y - kLine,
                         frame.left + x_axis.place(s.points[i].x_high) * width, y + kLine,
                         kHiddenInterval});
      }
      if (s.points[i].has_y_interval()) {
        const double height = frame.bottom - frame.top;
        boxes.push_back({x - kLine, frame.bottom - y_axis.place(s.points[i].y_high) * height,
                         x + kLine, frame.bottom - y_axis.place(s.points[i].y_low) * height,
                         kHiddenInterval});
      }
      if (!s.joined || i == 0) continue;
      const double dx = px(s.points[i - 1]) - x;
      const double dy = py(s.points[i - 1]) - y;
      const int pieces = static_cast<int>(std::hypot(dx, dy) / kEvery);
      for (int k = 1; k < pieces; ++k) {
        const double at = static_cast<double>(k) / pieces;
        boxes.push_back(
            {x + at * dx - kLine, y + at * dy - kLine, x + at * dx + kLine, y + at * dy + kLine});
      }
    }
  return boxes;
}

// Directions to try, preferred ones first: x and y in -1, 0, 1; y upwards.
constexpr std::array<std::array<int, 2>, 8> kDirections{
    {{1, 0}, {1, 1}, {1, -1}, {-1, 0}, {-1, 1}, {-1, -1}, {0, 1}, {0, -1}}};

// Distances from the point to try [px], and their cost as hidden area [px^2].
constexpr std::array<double, 5> kOffsets{0, 16, 32, 56, 84};
constexpr double kCostOfOffset = 8;  // per pixel of distance

Box label_box(double x, double y, double width, double height, const std::array<int, 2>& to,
              double offset) {
  constexpr double kGapSide = 10;
  constexpr double kGapUpright = 5;
  const double side = kGapSide + offset;
  const double upright = kGapUpright + offset;
  const double x0 = to[0] > 0 ? x + side : to[0] < 0 ? x - side - width : x - width / 2;
  const double y0 = to[1] > 0 ? y - upright - height : to[1] < 0 ? y + upright : y - height / 2;
  return {x0, y0, x0 + width, y0 + height};
}

struct Place {
  double x, y;  // [px]
};

double distance(const Place& a, const Place& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// The places of the points that have labels, in the order of series and points.
std::vector<Place> labelled_places(const std::vector<ChartSeries>& series, const Axis& x_axis,
                                   const Axis& y_axis, const ChartFrame& frame) {
  std::vector<Place> places;
  for (const ChartSeries& s : series)
    for (const ChartPoint& p : s.points)
      if (!p.label.empty())
        places.push_back({frame.left + x_axis.place(p.x) * (frame.right - frame.left),
                          frame.bottom - y_axis.place(p.y) * (frame.bottom - frame.top)});
  return places;
}

/// Where the text of a label begins, seen from its point.
Place near_end(const Box& box, const std::array<int, 2>& to) {
  return {to[0] > 0 ? box.x0 : to[0] < 0 ? box.x1 : (box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2};
}

double distance(const Box& box, const Place& p) {
  return std::hypot(std::max({box.x0 - p.x, p.x - box.x1, 0.}),
                    std::max({box.y0 - p.y, p.y - box.y1, 0.}));
}

/// The distance from `from`, a place or a box, to the nearest other place than number `own`.
template <class From>
double nearest_other(const From& from, const std::vector<Place>& places, std::size_t own) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < places.size(); ++i)
    if (i != own) least = std::min(least, distance(from, places[i]));
  return least;
}

/// Cost of a label near another labelled point than its own: readers take it for that of the
/// nearer one. The full cost moves a label away, but is not worth hiding another one.
double cost_of_mistake(const Box& box, const std::vector<Place>& places, std::size_t own) {
  constexpr double kMistaken = 1500;  // [px^2]
  constexpr double kClear = 8;        // nothing if its own point is nearer by this [px]
  const double nearer = nearest_other(box, places, own) - distance(box, places[own]);
  return kMistaken * std::clamp(1 - nearer / kClear, 0., 1.);
}

double cost_of(const Box& box, const std::vector<Box>& taken, const ChartFrame& frame) {
  constexpr double kOutside = 20;  // cost factor outside the plot box
  const double area = (box.x1 - box.x0) * (box.y1 - box.y0);
  double cost =
      kOutside * (area - overlap(box, {frame.left, frame.top, frame.right, frame.bottom}));
  for (const Box& other : taken) cost += other.weight * overlap(box, other);
  return cost;
}

}  // namespace

std::string tick_text(double value) {
  const double size = std::abs(value);
  if (size == 0) return "0";
  if (size >= 1e-4 && size < 1e6) return fmt::format("{:.6g}", value);
  return power_text(value);
}

std::string power_text(double value) {
  const double size = std::abs(value);
  if (size >= 0.01 && size < 1e3) return fmt::format("{:.3g}", value);
  if (size == 0) return "0";
  const int exponent = static_cast<int>(std::floor(std::log10(size) + 1e-9));
  const std::string mantissa = fmt::format("{:.3g}", value / std::pow(10., exponent));
  const std::string power = "10" + superscript(exponent);
  return mantissa == "1" ? power : mantissa + "·" + power;
}

double Axis::place(double value) const {
  if (!log) return (value - low) / (high - low);
  if (!(value > low)) return 0;
  return std::log(value / low) / std::log(high / low);
}

Axis make_axis(const std::vector<double>& values, bool log) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double v : values) {
    if (log && !(v > 0)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  Axis axis;
  axis.log = log;
  if (log) {
    if (!(low <= high)) low = high = 1;
    constexpr double kLeastRatio = 1.5;  // least range, for a single value
    const double ratio = std::max(high / low, kLeastRatio);
    const double middle = std::sqrt(low) * std::sqrt(high);
    axis.low = middle / std::pow(ratio, 0.5 + kRoom);
    axis.high = middle * std::pow(ratio, 0.5 + kRoom);
    axis.ticks = log_ticks(axis.low, axis.high);
    return axis;
  }
  // Start at zero if the values are near it, so that lengths can be compared by eye.
  constexpr double kNearZero = 0.5;
  if (low > 0 && low < kNearZero * high) low = 0;
  const double size = high > low ? high - low : std::max(std::abs(high), 1.);
  axis.low = low == 0 ? 0 : low - kRoom * size;
  axis.high = high + kRoom * size;
  axis.ticks = linear_ticks(axis.low, axis.high, tick_text);
  return axis;
}

double text_width(const std::string& text, double font_size) {
  constexpr double kMeanLetter = 0.58;  // mean width of digits and lower-case letters / font size
  const auto letters = std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80;
  });
  return kMeanLetter * font_size * static_cast<double>(letters);
}

std::vector<PlacedLabel> place_labels(const std::vector<ChartSeries>& series, const Axis& x_axis,
                                      const Axis& y_axis, const ChartFrame& frame) {
  const double plot_width = frame.right - frame.left;
  const double plot_height = frame.bottom - frame.top;
  constexpr double kHiddenLabel = 5;
  // Points this close have symbols that overlap [px]: only lines show which label is whose.
  constexpr double kCoincident = 12;
  std::vector<Box> taken = obstacles(series, x_axis, y_axis, frame);
  const std::vector<Place> places = labelled_places(series, x_axis, y_axis, frame);
  std::vector<PlacedLabel> labels;
  for (std::size_t s = 0; s < series.size(); ++s)
    for (const ChartPoint& point : series[s].points) {
      if (point.label.empty()) continue;
      const std::size_t number = labels.size();
      const auto& [x, y] = places[number];
      const bool coincident = nearest_other(places[number], places, number) < kCoincident;
      const double width = text_width(point.label, frame.font * kLabelFont);
      const double height = frame.font * 1.1;
      Box best{};
      std::array<int, 2> direction{};
      double offset = 0;
      double least = std::numeric_limits<double>::infinity();
      for (const double candidate : kOffsets) {
        if (candidate == 0 && coincident) continue;
        for (std::size_t d = 0; d < kDirections.size(); ++d) {
          const Box box = label_box(x, y, width, height, kDirections[d], candidate);
          const double cost = cost_of(box, taken, frame) + cost_of_mistake(box, places, number) +
                              static_cast<double>(d) + kCostOfOffset * candidate;
          if (cost >= least) continue;
          least = cost;
          best = box;
          direction = kDirections[d];
          offset = candidate;
        }
      }
      best.weight = kHiddenLabel;
      taken.push_back(best);
      const TextAnchor anchor = direction[0] > 0   ? TextAnchor::left
                                : direction[0] < 0 ? TextAnchor::right
                                                   : TextAnchor::center;
      const Place at = near_end(best, direction);
      labels.push_back({point.label, (at.x - frame.left) / plot_width,
                        (frame.bottom - at.y) / plot_height, anchor, s, offset > 0,
                        (x - frame.left) / plot_width, (frame.bottom - y) / plot_height});
    }
  return labels;
}

}  // namespace springlod::report
