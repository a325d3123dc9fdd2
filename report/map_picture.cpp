#include "report/map_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.hpp"
#include "report/chart_layout.hpp"

namespace springlod::report {
namespace {

namespace fs = std::filesystem;

// All coordinates in pixels, y downwards.
constexpr double kPanelHeight = 200;
constexpr double kLeft = 116;
constexpr double kRight = 28;
constexpr double kTop = 92;  // title and names of the integrators
constexpr double kGapAcross = 14;
constexpr double kGapDown = 22;
constexpr double kBottom = 142;  // ratios and legend
constexpr double kFont = 14;

// Colours of errors from kBestError to kWorstError on a logarithmic scale: the reversed viridis
// map, in which small errors are bright.
constexpr double kBestError = 1e-4;
constexpr double kWorstError = 1;
constexpr std::array<const char*, 8> kColours{"#fde725", "#a0da39", "#4ac16d", "#1fa187",
                                              "#277f8e", "#365c8d", "#46327e", "#440154"};
constexpr const char* kInk = "#14171B";
constexpr const char* kSoftInk = "#5F6570";
constexpr const char* kLimitInk = "#E4002B";
constexpr int kDivergedPattern = 4;   // gnuplot fill pattern: rising lines
constexpr int kMechanismPattern = 2;  // gnuplot fill pattern: crossed lines

// Half height of a cell without neighbours, as a factor of the step.
constexpr double kLoneCell = 1.4;

// The step axis ends at most this factor above the largest step, even if the limit is higher [1].
constexpr double kLimitRoom = 10;
// Factor between the end of the axis and what is drawn [1].
constexpr double kMargin = 1.1;

struct Scheme {
  sim::Integrator integrator;
  std::uint32_t iterations;
  bool operator==(const Scheme&) const = default;
};

Scheme scheme_of(const sim::StabilityPoint& point) {
  return {point.integrator, point.iterations};
}

std::pair<std::string, std::string> heading(const Scheme& scheme) {
  const sim::IntegratorChoice::Traits& traits = choice_of(scheme.integrator).traits;
  const auto& [first, second] = traits.heading;
  if (!traits.swept) return {first, second};
  return {first,
          fmt::format("{} {}{}", scheme.iterations, second, scheme.iterations == 1 ? "" : "s")};
}

template <class T>
std::size_t place_of(const std::vector<T>& values, const T& value) {
  return static_cast<std::size_t>(std::find(values.begin(), values.end(), value) - values.begin());
}

template <class T>
void add_once(std::vector<T>& values, const T& value) {
  if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
}

struct Rect {
  double left, top, right, bottom;
};

/// Collects gnuplot objects and labels in pixel coordinates.
class Sheet {
 public:
  void fill(const Rect& r, const std::string& style) {
    text_ += fmt::format("set object {} rectangle from {:.1f},{:.1f} to {:.1f},{:.1f} {}\n",
                         ++objects_, r.left, r.bottom, r.right, r.top, style);
  }
  void colour(const Rect& r, const char* colour) {
    fill(r, fmt::format("fc rgb '{}' fs solid noborder", colour));
  }
  void hatch(const Rect& r, int pattern) {
    colour(r, "#ECEEF1");
    fill(r, fmt::format("fc rgb '#A3AAB3' fs transparent pattern {} noborder", pattern));
  }
  void frame(const Rect& r) { fill(r, fmt::format("fs empty border rgb '{}' lw 1", kSoftInk)); }
  /// Above what is filled, below what is written.
  void line(double x0, double y0, double x1, double y1, const char* colour, double width) {
    text_ += fmt::format(
        "set arrow {} from {:.1f},{:.1f} to {:.1f},{:.1f} nohead back lw {} lc rgb '{}'\n",
        ++arrows_, x0, y0, x1, y1, width, colour);
  }
  void write(double x, double y, const std::string& text, const char* anchor, double size,
             const char* colour = kInk, const char* more = "") {
    text_ += fmt::format(
        "set label {} {} at {:.1f},{:.1f} {} font ',{:.4g}' textcolor rgb '{}' front {}\n",
        ++labels_, gnuplot_quoted(text), x, y, anchor, size * unit_, colour, more);
  }
  explicit Sheet(double font_unit) : unit_(font_unit) {}
  const std::string& text() const { return text_; }

 private:
  double unit_;
  std::string text_;
  int objects_ = 0;
  int arrows_ = 0;
  int labels_ = 0;
};

const char* colour_of(double error) {
  const double part = std::log(error / kBestError) / std::log(kWorstError / kBestError);
  const double place = std::floor(part * static_cast<double>(kColours.size()));
  const double last = static_cast<double>(kColours.size() - 1);
  return kColours[static_cast<std::size_t>(std::clamp(place, 0., last))];
}

/// Text in a cell, for verdicts that its colour does not show.
const char* mark_of(sim::Verdict verdict) {
  switch (verdict) {
    case sim::Verdict::drifting:
      return "~";
    case sim::Verdict::off_design:
      return "o";
    case sim::Verdict::crossed:
      return "x";
    case sim::Verdict::unconverged:
      return "!";
    case sim::Verdict::stable:
    case sim::Verdict::inaccurate:
    case sim::Verdict::runaway:
    case sim::Verdict::diverged:
    case sim::Verdict::mechanism:
      break;
  }
  return "";
}

/// Draws one stability map.
class Picture {
 public:
  Picture(const sim::StabilityMap& map, double font_unit) : map_(map), sheet_(font_unit) {
    for (const sim::StabilityBody& body : map.bodies) {
      add_once(levels_, body.level);
      add_once(ratios_, body.ratio);
    }
    for (const sim::StabilityPoint& point : map.points) add_once(schemes_, scheme_of(point));
    constexpr double kWidest = 160;
    constexpr double kNarrowest = 116;
    constexpr double kSheet = 1120;  // width available for panels
    panel_width_ = std::clamp(kSheet / static_cast<double>(schemes_.size()), kNarrowest, kWidest);
    find_steps();
  }

  double width() const {
    const auto columns = static_cast<double>(schemes_.size());
    // The legend needs a minimum width.
    constexpr double kLeast = 930;
    return std::max(kLeast, kLeft + columns * panel_width_ + (columns - 1) * kGapAcross + kRight);
  }
  double height() const {
    const auto rows = static_cast<double>(levels_.size());
    return kTop + rows * kPanelHeight + (rows - 1) * kGapDown + kBottom;
  }

  std::string draw(const std::string& title) {
    if (!title.empty()) sheet_.write(width() / 2, 24, title, "center", kFont * 1.2);
    for (std::size_t column = 0; column < schemes_.size(); ++column) {
      const double middle = (panel(0, column).left + panel(0, column).right) / 2;
      const auto [first, second] = heading(schemes_[column]);
      sheet_.write(middle, kTop - 34, first, "center", kFont);
      sheet_.write(middle, kTop - 15, second, "center", kFont);
    }
    for (std::size_t row = 0; row < levels_.size(); ++row) {
      write_steps(row);
      for (std::size_t column = 0; column < schemes_.size(); ++column) draw_panel(row, column);
    }
    for (std::size_t column = 0; column < schemes_.size(); ++column) write_ratios(column);
    write_legend();
    return sheet_.text();
  }

 private:
  struct Cell {
    const sim::StabilityPoint* point;
    double low, high;  // lower and upper step of the drawn cell [s]
  };

  Rect panel(std::size_t row, std::size_t column) const {
    const double left = kLeft + static_cast<double>(column) * (panel_width_ + kGapAcross);
    const double top = kTop + static_cast<double>(row) * (kPanelHeight + kGapDown);
    return {left, top, left + panel_width_, top + kPanelHeight};
  }
  Rect column_of(const Rect& panel, double ratio) const {
    const double width = panel_width_ / static_cast<double>(ratios_.size());
    const double left = panel.left + width * static_cast<double>(place_of(ratios_, ratio));
    return {left, panel.top, left + width, panel.bottom};
  }
  double y_of(const Rect& panel, double step) const {
    const double place = std::log(step / low_) / std::log(high_ / low_);
    return panel.bottom - std::clamp(place, 0., 1.) * (panel.bottom - panel.top);
  }

  // Cells extend halfway to their neighbours.
  std::vector<Cell> cells_of(const Scheme& scheme, std::uint32_t level, double ratio) const {
    std::vector<Cell> cells;
    for (const sim::StabilityPoint& point : map_.points) {
      const sim::StabilityBody& body = map_.bodies[point.body];
      if (scheme_of(point) == scheme && body.level == level && body.ratio == ratio)
        cells.push_back({&point, 0, 0});
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto between = [&](std::size_t a, std::size_t b) {
        return std::sqrt(cells[a].point->step * cells[b].point->step);
      };
      const double step = cells[i].point->step;
      const bool first = i == 0;
      const bool last = i + 1 == cells.size();
      if (!first) cells[i].low = between(i - 1, i);
      if (!last) cells[i].high = between(i, i + 1);
      if (first) cells[i].low = last ? step / kLoneCell : step * step / cells[i].high;
      if (last) cells[i].high = first ? step * kLoneCell : step * step / cells[i].low;
    }
    return cells;
  }

  void find_steps() {
    low_ = high_ = map_.points.front().step;
    double highest_limit = 0;
    for (const Scheme& scheme : schemes_)
      for (const sim::StabilityBody& body : map_.bodies)
        for (const Cell& cell : cells_of(scheme, body.level, body.ratio)) {
          low_ = std::min({low_, cell.low, cell.point->limit});
          high_ = std::max(high_, cell.high);
          highest_limit = std::max(highest_limit, cell.point->limit);
        }
    high_ = std::max(high_, std::min(highest_limit, kLimitRoom * high_));
    low_ /= kMargin;
    high_ *= kMargin;
  }

  void draw_panel(std::size_t row, std::size_t column) {
    const Rect place = panel(row, column);
    double before_x = 0;
    double before_y = 0;
    for (std::size_t i = 0; i < ratios_.size(); ++i) {
      const Rect strip = column_of(place, ratios_[i]);
      const std::vector<Cell> cells = cells_of(schemes_[column], levels_[row], ratios_[i]);
      for (const Cell& cell : cells) draw_cell(strip, cell);
      if (cells.empty()) continue;
      const double y = y_of(place, cells.front().point->limit);
      const double x = (strip.left + strip.right) / 2;
      if (i == 0) limit_line(strip.left, y, x, y);
      if (i > 0) limit_line(before_x, before_y, x, y);
      if (i + 1 == ratios_.size()) limit_line(x, y, strip.right, y);
      before_x = x;
      before_y = y;
    }
    sheet_.frame(place);
  }

  void draw_cell(const Rect& strip, const Cell& cell) {
    constexpr double kSeam = 0.5;
    const Rect place{strip.left + kSeam, y_of(strip, cell.high) + kSeam, strip.right - kSeam,
                     y_of(strip, cell.low) - kSeam};
    if (cell.point->verdict == sim::Verdict::mechanism)
      return sheet_.hatch(place, kMechanismPattern);
    if (!cell.point->stable) return sheet_.hatch(place, kDivergedPattern);
    sheet_.colour(place, colour_of(cell.point->error));
    const char* mark = mark_of(cell.point->verdict);
    if (*mark == '\0') return;
    constexpr double kBright = 0.01;  // errors below it have bright colours, which need dark text
    sheet_.write((place.left + place.right) / 2, (place.top + place.bottom) / 2, mark, "center",
                 kFont * 0.8, cell.point->error < kBright ? kInk : "#FFFFFF");
  }

  void limit_line(double x0, double y0, double x1, double y1) {
    sheet_.line(x0, y0, x1, y1, kLimitInk, 2.2);
  }

  void write_steps(std::size_t row) {
    const Rect place = panel(row, 0);
    const double middle = (place.top + place.bottom) / 2;
    const auto level = levels_[row];
    const auto body = std::find_if(map_.bodies.begin(), map_.bodies.end(),
                                   [&](const sim::StabilityBody& b) { return b.level == level; });
    sheet_.write(22, middle, fmt::format("level {}: {} nodes", level, body->nodes), "center", kFont,
                 kInk, "rotate by 90");
    sheet_.write(48, middle, "step [s]", "center", kFont * 0.9, kSoftInk, "rotate by 90");
    constexpr double kTick = 5;
    for (int e = static_cast<int>(std::ceil(std::log10(low_))); std::pow(10., e) <= high_; ++e) {
      const double y = y_of(place, std::pow(10., e));
      sheet_.line(place.left - kTick, y, place.left, y, kSoftInk, 1);
      sheet_.write(place.left - kTick - 4, y, power_text(std::pow(10., e)), "right", kFont * 0.9);
    }
  }

  void write_ratios(std::size_t column) {
    const Rect place = panel(levels_.size() - 1, column);
    for (const double ratio : ratios_) {
      const Rect strip = column_of(place, ratio);
      sheet_.write((strip.left + strip.right) / 2, place.bottom + 13, power_text(ratio), "center",
                   kFont * 0.8);
    }
    if (column == 0)
      sheet_.write(place.left, place.bottom + 36,
                   "Young's modulus, stiff over soft (stiff: " + map_.stiff_part + ")", "left",
                   kFont * 0.9, kSoftInk);
  }

  void write_legend() {
    const double top = panel(levels_.size() - 1, 0).bottom + 62;
    constexpr double kBox = 34;
    constexpr double kHigh = 16;
    double x = kLeft;
    for (const char* colour : kColours) {
      sheet_.colour({x, top, x + kBox, top + kHigh}, colour);
      x += kBox;
    }
    sheet_.frame({kLeft, top, x, top + kHigh});
    const double decade = (x - kLeft) / std::log10(kWorstError / kBestError);
    constexpr std::array<const char*, 5> kTexts{"0.01 %", "0.1 %", "1 %", "10 %", "100 %"};
    for (std::size_t i = 0; i < kTexts.size(); ++i)
      sheet_.write(kLeft + decade * static_cast<double>(i), top + kHigh + 13, kTexts[i], "center",
                   kFont * 0.8);
    sheet_.write((kLeft + x) / 2, top + kHigh + 34, "error against a reference run", "center",
                 kFont * 0.85, kSoftInk);

    const double text = 8;
    const double next_row = 26;
    x += 48;
    sheet_.hatch({x, top, x + kBox, top + kHigh}, kDivergedPattern);
    sheet_.write(x + kBox + text, top + kHigh / 2, "diverged, or its energy doubled", "left",
                 kFont * 0.85);
    sheet_.hatch({x, top + next_row, x + kBox, top + next_row + kHigh}, kMechanismPattern);
    sheet_.write(x + kBox + text, top + next_row + kHigh / 2, "mechanism, not run", "left",
                 kFont * 0.85);
    sheet_.write(x, top + 2 * next_row + kHigh / 2,
                 "~ energy drift   o off design   ! not converged   x springs inverted", "left",
                 kFont * 0.85);
    x += 268;
    sheet_.line(x, top + kHigh / 2, x + kBox, top + kHigh / 2, kLimitInk, 2.2);
    sheet_.write(x + kBox + text, top + kHigh / 2, "predicted explicit limit", "left",
                 kFont * 0.85);
  }

  const sim::StabilityMap& map_;
  Sheet sheet_;
  std::vector<std::uint32_t> levels_;
  std::vector<double> ratios_;
  std::vector<Scheme> schemes_;
  double panel_width_ = 0;
  double low_ = 0;   // step at the lower edge of the panels [s]
  double high_ = 0;  // step at the upper edge [s]
};

}  // namespace

Drawing draw_map(const sim::StabilityMap& map, const std::string& title, const fs::path& path) {
  require_picture_name(path);
  if (map.points.empty()) throw InputError("chart: the stability map has no points to draw");
  Picture picture(map, gnuplot_font_unit(path));
  std::string script = gnuplot_terminal(path, picture.width(), picture.height(), kFont);
  script += fmt::format(
      "set margins 0,0,0,0\nset xrange [0:{0}]\nset yrange [{1}:0]\nunset border\nunset tics\n"
      "unset key\n",
      picture.width(), picture.height());
  script += picture.draw(title);
  // gnuplot draws the objects with the next plot: a dummy point outside the sheet.
  script += "plot '-' using 1:2 with points notitle\n-1 -1\ne\n";
  return draw_with_gnuplot(script, path);
}

}  // namespace springlod::report
