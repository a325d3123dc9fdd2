#include "report/chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"
#include "report/chart_layout.hpp"
#include "report/csv.hpp"
#include "report/gnuplot.hpp"

namespace springlod::report {
namespace {

namespace fs = std::filesystem;

// Colours of ChartColour: the Okabe-Ito palette without yellow, which is hard to see on white, and
// black.
constexpr std::array<const char*, 8> kColours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                              "#E69F00", "#56B4E9", "#5F6570", "#14171B"};
constexpr std::size_t kOwnColours = kColours.size() - 1;  // default colours of series
// gnuplot point types of ChartSymbol, without none. Series differ in shape as well as in colour,
// for colour-blind readers.
constexpr std::array<int, 7> kShapes{7, 5, 9, 13, 11, 15, 6};
constexpr std::size_t kOwnShapes = kShapes.size() - 1;

constexpr std::size_t kManyPoints = 40;  // above it intervals are drawn transparent

/// How a series looks.
struct Look {
  const char* colour;
  int shape;   ///< 0: none
  int hollow;  ///< point type of the outline
  double size;
};

Look look_of(const std::vector<ChartSeries>& series, std::size_t number) {
  constexpr double kSize = 1.2;  // symbol size in gnuplot units
  constexpr double kRingSize = 2.4;
  constexpr double kSmallSize = 0.6;         // of a cloud,
  constexpr std::size_t kCloudPoints = 400;  // a series of more points than this
  const ChartSeries& s = series[number];
  const std::size_t colour = s.colour ? static_cast<std::size_t>(*s.colour) : number % kOwnColours;
  const std::size_t symbol = s.symbol ? static_cast<std::size_t>(*s.symbol) : number % kOwnShapes;
  const bool none = s.symbol == ChartSymbol::none;
  const bool ring = s.symbol == ChartSymbol::ring;
  const int shape = none ? 0 : kShapes[symbol];
  return {kColours[colour], shape, ring ? shape : shape - 1,
          ring                             ? kRingSize
          : s.points.size() > kCloudPoints ? kSmallSize
                                           : kSize};
}

void require_drawable(const std::vector<ChartSeries>& series, const fs::path& path) {
  require_picture_name(path);
  std::size_t points = 0;
  for (const ChartSeries& s : series)
    for (const ChartPoint& p : s.points) {
      ++points;
      const std::array all{p.x, p.y, p.x_low, p.x_high, p.y_low, p.y_high};
      if (!std::all_of(all.begin(), all.end(), [](double v) { return std::isfinite(v); }))
        throw InputError(fmt::format("chart: series \"{}\" has a point ({}, {}) that is not finite",
                                     s.name, p.x, p.y));
    }
  if (points == 0) throw InputError("chart: there are no points to draw");
}

/// gnuplot takes a line break in a cell for the end of the row, and ends text at any double quote.
std::string plain_cell(std::string text) {
  std::replace(text.begin(), text.end(), '"', '\'');
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

Table data_table(const std::vector<ChartSeries>& series) {
  Table table{{"series", "x", "y", "y_low", "y_high", "label", "x_low", "x_high"}, {}};
  for (const ChartSeries& s : series)
    for (const ChartPoint& p : s.points) {
      const bool y = p.has_y_interval();
      const bool x = p.has_x_interval();
      table.rows.push_back({plain_cell(s.name), p.x, p.y, y ? p.y_low : p.y, y ? p.y_high : p.y,
                            plain_cell(p.label), x ? p.x_low : p.x, x ? p.x_high : p.x});
    }
  return table;
}

struct Axes {
  Axis x, y;
};

Axes make_axes(const std::vector<ChartSeries>& series, const ChartOptions& options) {
  std::vector<double> x;
  std::vector<double> y;
  for (const ChartSeries& s : series)
    for (const ChartPoint& p : s.points) {
      x.push_back(p.x);
      y.push_back(p.y);
      if (p.has_x_interval()) x.insert(x.end(), {p.x_low, p.x_high});
      if (p.has_y_interval()) y.insert(y.end(), {p.y_low, p.y_high});
    }
  if (options.log_y) std::erase_if(y, [&](double v) { return !(v > options.y_from); });
  return {make_axis(x, options.log_x), make_axis(y, options.log_y)};
}

// Layout of the key: in rows between title and plot, so that it hides no point.
struct Key {
  int columns = 0;  // 0: no key
  double height = 0;
  bool dashed = false;  // longer samples with wider gaps
};

Key plan_key(const std::vector<ChartSeries>& series, const ChartFrame& frame) {
  const bool dashed =
      std::any_of(series.begin(), series.end(), [](const ChartSeries& s) { return s.dashed; });
  const double sample = dashed ? 100 : 72;  // line sample and gaps [px]; a longer one shows dashes
  double widest = 0;
  int named = 0;
  for (const ChartSeries& s : series) {
    if (s.name.empty()) continue;
    ++named;
    widest = std::max(widest, text_width(s.name, frame.font) + sample);
  }
  if (named == 0) return {};
  const int fit = std::max(1, static_cast<int>((frame.right - frame.left) / widest));
  const int columns = std::min(fit, named);
  const int rows = (named + columns - 1) / columns;
  return {columns, rows * frame.font * 1.5, dashed};
}

ChartFrame frame_of(const std::vector<ChartSeries>& series, const ChartOptions& options) {
  ChartFrame frame;
  frame.right += options.width - frame.width;
  frame.bottom += options.height - frame.height;
  frame.width = options.width;
  frame.height = options.height;
  constexpr double kTitleSpace = 2.6;  // [font sizes]
  frame.top = (options.title.empty() ? 1 : kTitleSpace) * frame.font +
              plan_key(series, frame).height + 0.6 * frame.font;
  return frame;
}

std::string axis_lines(const char* letter, const Axis& axis, const std::string& label) {
  std::string ticks;
  for (const Tick& tick : axis.ticks)
    ticks += fmt::format("{}{} {}", ticks.empty() ? "" : ", ", gnuplot_quoted(tick.text),
                         number_text(tick.value));
  std::string text = axis.log ? fmt::format("set logscale {}\n", letter)
                              : fmt::format("unset logscale {}\n", letter);
  text +=
      fmt::format("set {}range [{}:{}]\n", letter, number_text(axis.low), number_text(axis.high));
  text += fmt::format("set {}tics ({})\n", letter, ticks);
  text += fmt::format("set {}label {}\n", letter, gnuplot_quoted(label));
  return text;
}

std::string style_lines(const ChartFrame& frame, const ChartOptions& options, const Key& key,
                        double unit) {
  std::string text;
  text += fmt::format("set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n",
                      frame.left / frame.width, frame.right / frame.width);
  text += fmt::format("set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n",
                      1 - frame.top / frame.height, 1 - frame.bottom / frame.height);
  text +=
      "set border 3 lc rgb '#5F6570' lw 1\n"
      "set tics nomirror scale 0.6 textcolor rgb '#2B2F36'\n"
      "set grid lc rgb '#DFE3E8' lw 1 lt 1\n";
  if (!options.title.empty())
    text += fmt::format(
        "set label 1 {} at screen 0.5,{:.4f} center font ',{:.4g}' textcolor rgb '#14171B'\n",
        gnuplot_quoted(options.title), 1 - 1.5 * frame.font / frame.height,
        frame.font * unit * 1.2);
  if (key.columns == 0)
    text += "unset key\n";
  else
    text += fmt::format(
        "set key at graph 0.5,{:.4f} center bottom horizontal maxcols {} Left reverse {} "
        "textcolor rgb '#2B2F36'\n",
        1 + 0.4 * frame.font / (frame.bottom - frame.top), key.columns,
        key.dashed ? "samplen 3 width 1" : "samplen 2");
  return text;
}

std::string label_lines(const std::vector<ChartSeries>& series,
                        const std::vector<PlacedLabel>& labels, double font_size) {
  static constexpr std::array<const char*, 3> kAnchors{"left", "center", "right"};
  // White boxes behind labels, so that lines do not cross the text.
  std::string text = "set style textbox opaque margins 0.2,0.2 fillcolor rgb 'white' noborder\n";
  int number = 10;
  for (const PlacedLabel& label : labels) {
    const char* line_colour = look_of(series, label.series).colour;
    if (label.led)
      text += fmt::format(
          "set arrow from graph {:.5f},{:.5f} to graph {:.5f},{:.5f} nohead lw 0.8 lc rgb '{}'\n",
          label.point_x, label.point_y, label.x, label.y, line_colour);
    text += fmt::format(
        "set label {} {} at graph {:.5f},{:.5f} {} font ',{:.4g}' "
        "textcolor rgb '{}' front boxed\n",
        number++, gnuplot_quoted(label.text), label.x, label.y,
        kAnchors[static_cast<std::size_t>(label.anchor)], font_size, line_colour);
  }
  return text;
}

// A log axis cannot show 0 and values below its range: such points are drawn hollow at its lower
// end.
std::string edge_point_lines(const std::vector<ChartSeries>& series, const ChartOptions& options,
                             const Axes& axes) {
  std::string text;
  int number = 1;
  for (std::size_t s = 0; s < series.size(); ++s)
    for (const ChartPoint& p : series[s].points) {
      const Look look = look_of(series, s);
      if (look.shape == 0) continue;
      const bool off = (axes.x.log && !(p.x > 0)) || (axes.y.log && !(p.y > options.y_from));
      if (!off) continue;
      constexpr int kFirst = 1000;  // first label number of these
      text += fmt::format("set label {} '' at graph {:.5f},{:.5f} point pt {} ps 1.2 lc rgb '{}'\n",
                          kFirst + number++, axes.x.place(p.x), axes.y.place(p.y), look.hollow,
                          look.colour);
    }
  return text;
}

/// gnuplot colour of intervals; transparent if there are many, so that points stay visible.
std::string interval_colour(const char* colour, bool many) {
  constexpr const char* kTransparent = "99";  // alpha, 00..ff
  return many ? fmt::format("#{}{}", kTransparent, colour + 1) : colour;
}

std::string interval_line(const ChartSeries& series, const std::string& rows,
                          const std::string& line_colour) {
  const auto any = [&](auto has) {
    return std::any_of(series.points.begin(), series.points.end(),
                       [&](const ChartPoint& p) { return (p.*has)(); });
  };
  const char* columns = any(&ChartPoint::has_x_interval)   ? "2:3:7:8:4:5 with xyerrorbars"
                        : any(&ChartPoint::has_y_interval) ? "2:3:4:5 with yerrorbars"
                                                           : nullptr;
  if (columns == nullptr) return "";
  return fmt::format("{} using {} pt 0 lw 1.2 lc rgb '{}' notitle, \\\n     ", rows, columns,
                     line_colour);
}

std::string plot_lines(const std::vector<ChartSeries>& series, const std::string& data) {
  std::string text;
  std::size_t first = 0;
  std::size_t points = 0;
  for (const ChartSeries& s : series) points += s.points.size();
  for (std::size_t s = 0; s < series.size(); ++s) {
    const std::size_t count = series[s].points.size();
    if (count == 0 && series[s].name.empty()) continue;
    const Look look = look_of(series, s);
    const std::string rows =
        fmt::format("{} skip 1 every ::{}::{}", gnuplot_quoted(data), first, first + count - 1);
    first += count;
    text += text.empty() ? "plot " : ", \\\n     ";
    if (count > 0)
      text += interval_line(series[s], rows, interval_colour(look.colour, points > kManyPoints));
    text += count > 0 ? rows + " using 2:3" : "NaN";
    if (look.shape == 0)
      text += " with lines";
    else
      text += fmt::format(" with {} pt {} ps {:.2g}", series[s].joined ? "linespoints" : "points",
                          look.shape, look.size);
    text +=
        fmt::format(" lw 2{} lc rgb '{}' {}", series[s].dashed ? " dt 2" : "", look.colour,
                    series[s].name.empty() ? "notitle" : "title " + gnuplot_quoted(series[s].name));
  }
  return text + "\n";
}

// Points at the end of a log axis show their value in their label.
std::vector<ChartSeries> with_edge_labels(std::vector<ChartSeries> series,
                                          const ChartOptions& options) {
  for (ChartSeries& s : series) {
    if (s.symbol == ChartSymbol::none) continue;
    for (ChartPoint& p : s.points) {
      if (options.log_y && !(p.y > options.y_from))
        p.label += fmt::format(" (y = {})", power_text(p.y));
      if (options.log_x && !(p.x > 0)) p.label += fmt::format(" (x = {})", power_text(p.x));
    }
  }
  return series;
}

std::string gnuplot_script(const std::vector<ChartSeries>& series, const ChartOptions& options,
                           const fs::path& path, const std::string& data) {
  const ChartFrame frame = frame_of(series, options);
  const Key key = plan_key(series, frame);
  const Axes axes = make_axes(series, options);
  std::string text = gnuplot_terminal(path, frame.width, frame.height, frame.font);
  text += "set datafile separator comma\n";
  text += style_lines(frame, options, key, gnuplot_font_unit(path));
  text += axis_lines("x", axes.x, options.x_label);
  text += axis_lines("y", axes.y, options.y_label);
  text +=
      label_lines(series, place_labels(with_edge_labels(series, options), axes.x, axes.y, frame),
                  kLabelFont * frame.font * gnuplot_font_unit(path));
  text += edge_point_lines(series, options, axes);
  text += plot_lines(series, data);
  return text;
}

}  // namespace

ChartFiles draw_chart(const std::vector<ChartSeries>& series, const ChartOptions& options,
                      const fs::path& path) {
  require_drawable(series, path);
  ChartFiles files;
  files.data = fs::path(path).replace_extension(".csv");
  files.script = gnuplot_script_path(path);
  save_csv(data_table(series), files.data);
  const Drawing drawing = draw_with_gnuplot(
      gnuplot_script(series, options, path, files.data.filename().string()), path);
  files.drawn = drawing.drawn;
  files.command = drawing.command;
  return files;
}

}  // namespace springlod::report
