#include "render/overlay.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "render/anchor_marks.hpp"

namespace springlod::render {
namespace {

constexpr Colour kInk{0.13F, 0.15F, 0.18F};
constexpr Colour kPaleInk{0.33F, 0.36F, 0.40F};
constexpr Colour kPlate{1, 1, 1};
constexpr Colour kDivider{0.62F, 0.65F, 0.69F};
constexpr double kPlateAlpha = 0.72;

/// Sizes proportional to the height of the panel [px].
struct Sizes {
  double title, caption, small, pad, margin;
  explicit Sizes(int height)
      : title(std::clamp(height * 0.042, 13., 60.)),
        caption(title * 0.84),
        small(title * 0.74),
        pad(std::round(title * 0.40)),
        margin(std::round(title * 0.50)) {}
  double line(double size) const { return std::round(size * 1.28); }
};

/// Text of narrow panels is smaller, so that a title fits.
Sizes sizes_in(const PixelRect& panel) {
  constexpr double kNarrow = 1.15;  // height / width
  return Sizes(std::min(panel.height, static_cast<int>(kNarrow * panel.width)));
}

// Height of DejaVu letters above the baseline, as a fraction of the font size.
constexpr double kAscent = 0.80;

int whole(double v) {
  return static_cast<int>(std::lround(v));
}

int scale_thickness(const Sizes& sizes) {
  return whole(sizes.small * 0.55);
}
int scale_height(const Sizes& sizes) {
  return whole(2 * sizes.line(sizes.small) + scale_thickness(sizes) + 1.6 * sizes.pad);
}

std::string length_text(double metres) {
  if (metres >= 1000) return fmt::format("{:g} km", metres / 1000);
  if (metres >= 1) return fmt::format("{:g} m", metres);
  if (metres >= 0.01) return fmt::format("{:g} cm", metres * 100);
  if (metres >= 0.001) return fmt::format("{:g} mm", metres * 1000);
  return fmt::format("{:g} um", metres * 1e6);
}

}  // namespace

double heading_share(int panel_height, std::size_t captions) {
  const Sizes sizes(panel_height);
  return (sizes.margin + sizes.line(sizes.title) +
          static_cast<double>(captions) * sizes.line(sizes.caption) + 1.2 * sizes.pad) /
         panel_height;
}

double scale_share(int panel_height) {
  const Sizes sizes(panel_height);
  return (sizes.margin + scale_height(sizes)) / panel_height;
}

double footer_share(int panel_height) {
  const Sizes sizes(panel_height);
  return (sizes.margin + sizes.line(sizes.title) + sizes.pad) / panel_height;
}

LabelRoom room_beside_labels(double above, double below) {
  constexpr double kMost = 0.5;
  const double shrink = std::min(1., kMost / std::max(above + below, 1e-9));
  return {shrink * above, shrink * below};
}

void Overlay::draw_heading(Image& image, const PixelRect& panel, const PanelLabels& labels) {
  const Sizes sizes = sizes_in(panel);
  const double room = panel.width - 2 * (sizes.margin + sizes.pad);
  struct Line {
    std::string text;
    double size;
    Colour ink;
  };
  std::vector<Line> lines;
  if (!labels.title.empty())
    lines.push_back({text_.fitted(labels.title, sizes.title, room), sizes.title, kInk});
  for (const std::string& caption : labels.captions)
    lines.push_back({text_.fitted(caption, sizes.caption, room), sizes.caption, kPaleInk});
  if (lines.empty()) return;
  double width = 0;
  double height = 0;
  for (const Line& line : lines) {
    width = std::max(width, text_.width(line.text, line.size));
    height += sizes.line(line.size);
  }
  const PixelRect plate{panel.x + whole(sizes.margin), panel.y + whole(sizes.margin),
                        whole(width + 2 * sizes.pad), whole(height + 1.2 * sizes.pad)};
  fill_rounded(image, plate, sizes.pad, kPlate, kPlateAlpha);
  double y = plate.y + 0.6 * sizes.pad;
  for (const Line& line : lines) {
    const double leading = (sizes.line(line.size) - line.size) / 2;
    text_.draw(image, panel, plate.x + sizes.pad, y + leading + kAscent * line.size, line.text,
               line.size, line.ink);
    y += sizes.line(line.size);
  }
}

int Overlay::draw_scale(Image& image, const PixelRect& panel, const ColourScale& scale,
                        int bottom) {
  const Sizes sizes = sizes_in(panel);
  const auto half = [&](const ColourScale::Tick& tick) {
    return text_.width(tick.text, sizes.small) / 2;
  };
  const double before = scale.ticks.empty() ? 0 : half(scale.ticks.front());
  const double after = scale.ticks.empty() ? 0 : half(scale.ticks.back());
  const int bar = whole(panel.width * scale.bar_share);
  const int thick = scale_thickness(sizes);
  const std::string name =
      text_.fitted(scale.name, sizes.small, panel.width - 2 * (sizes.margin + sizes.pad));
  const double name_width = text_.width(name, sizes.small);
  // The name may be wider than the bar with its numbers.
  const double beside = std::max({0., (name_width - bar) / 2 - std::min(before, after)});
  const int width = bar + whole(before + after + 2 * (sizes.pad + beside));
  const int height = scale_height(sizes);
  const PixelRect plate{panel.x + panel.width - whole(sizes.margin) - width, bottom - height, width,
                        height};
  fill_rounded(image, plate, sizes.pad, kPlate, kPlateAlpha);
  const int x0 = plate.x + whole(sizes.pad + beside + before);
  const double name_base = plate.y + 0.7 * sizes.pad + kAscent * sizes.small;
  const int y0 = plate.y + whole(0.8 * sizes.pad + sizes.line(sizes.small));
  for (int x = 0; x < bar; ++x) {
    const Colour colour = scale.colour((x + 0.5) / bar);
    for (int y = 0; y < thick; ++y) blend_pixel(image, x0 + x, y0 + y, colour, 1);
  }
  const double numbers = y0 + thick + 0.2 * sizes.pad + kAscent * sizes.small + 1;
  text_.draw(image, panel, x0 + (bar - name_width) / 2, name_base, name, sizes.small, kInk);
  for (const ColourScale::Tick& tick : scale.ticks)
    text_.draw(image, panel, x0 + tick.part * bar - half(tick), numbers, tick.text, sizes.small,
               kPaleInk);
  return plate.y;
}

void Overlay::draw_panel(Image& image, const PixelRect& panel, const PanelLabels& labels) {
  const Sizes sizes = sizes_in(panel);
  draw_heading(image, panel, labels);
  // Above the footer, which may extend close to them.
  int bottom = panel.y + panel.height - whole(sizes.margin);
  for (const ColourScale& scale : labels.scales)
    bottom = draw_scale(image, panel, scale, bottom) - whole(sizes.margin / 2);
  const double left = panel.x + sizes.margin + sizes.pad;
  double base = panel.y + panel.height - sizes.margin - 0.4 * sizes.pad;
  if (labels.grid_spacing) {
    const std::string text = "grid " + length_text(*labels.grid_spacing);
    text_.draw(image, panel, left, base, text, sizes.small, kPaleInk);
    base -= sizes.line(sizes.small);
  }
  if (labels.anchors) {
    constexpr const char* kAnchored = "anchored";
    constexpr double kMiddle = 0.3;  // of small letters above the baseline / font size
    const double radius = anchor_mark_radius(panel);
    const double width = 2 * radius + sizes.pad + text_.width(kAnchored, sizes.small);
    fill_rounded(image,
                 {whole(left - sizes.pad / 2), whole(base - kAscent * sizes.small - sizes.pad / 4),
                  whole(width + sizes.pad), whole(sizes.line(sizes.small))},
                 sizes.pad / 2, kPlate, kPlateAlpha);
    draw_anchor_mark(image, panel, left + radius, base - kMiddle * sizes.small, radius);
    text_.draw(image, panel, left + 2 * radius + sizes.pad, base, kAnchored, sizes.small, kPaleInk);
  }
}

void Overlay::draw_footer(Image& image, const std::string& text, int panel_height) {
  if (text.empty()) return;
  const PixelRect all{0, 0, static_cast<int>(image.width), static_cast<int>(image.height)};
  const Sizes sizes(panel_height);
  const std::string line =
      text_.fitted(text, sizes.title, all.width - 2 * (sizes.margin + sizes.pad));
  const double width = text_.width(line, sizes.title);
  const PixelRect plate{whole((all.width - width) / 2 - sizes.pad),
                        whole(all.height - sizes.margin - sizes.line(sizes.title) - sizes.pad),
                        whole(width + 2 * sizes.pad), whole(sizes.line(sizes.title) + sizes.pad)};
  fill_rounded(image, plate, sizes.pad, kPlate, kPlateAlpha);
  const double leading = (sizes.line(sizes.title) - sizes.title) / 2;
  text_.draw(image, all, plate.x + sizes.pad,
             plate.y + sizes.pad / 2 + leading + kAscent * sizes.title, line, sizes.title, kInk);
}

void Overlay::draw_dividers(Image& image, const PixelRect& first_panel) {
  constexpr int kThick = 2;  // [px]
  const auto line = [&](int x, int y, int width, int height) {
    for (int row = y; row < y + height; ++row)
      for (int column = x; column < x + width; ++column)
        blend_pixel(image, column, row, kDivider, 1);
  };
  const int width = static_cast<int>(image.width);
  const int height = static_cast<int>(image.height);
  for (int x = first_panel.width; x < width; x += first_panel.width)
    line(x - kThick / 2, first_panel.y, kThick, height - first_panel.y);
  // Also below the title, if there is one.
  for (int y = first_panel.y > 0 ? first_panel.y : first_panel.height; y < height;
       y += first_panel.height)
    line(0, y - kThick / 2, width, kThick);
}

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

constexpr double kTitleFactor = 1.25;  // size relative to panel titles

}  // namespace

int Overlay::title_height(const std::string& title, int panel_height) {
  const Sizes sizes(panel_height);
  double height = 0;
  for (std::size_t i = 0; i < lines_of(title).size(); ++i)
    height += sizes.line(i == 0 ? kTitleFactor * sizes.title : sizes.title);
  return height > 0 ? whole(height + 2 * sizes.pad) : 0;
}

void Overlay::draw_title(Image& image, const std::string& title, int panel_height) {
  const Sizes sizes(panel_height);
  const PixelRect strip{0, 0, static_cast<int>(image.width), title_height(title, panel_height)};
  fill_rounded(image, strip, 0, kPlate, 1);
  double y = sizes.pad;
  bool first = true;
  for (const std::string& text : lines_of(title)) {
    const double size = first ? kTitleFactor * sizes.title : sizes.title;
    const std::string line = text_.fitted(text, size, strip.width - 2 * sizes.margin);
    const double leading = (sizes.line(size) - size) / 2;
    text_.draw(image, strip, (strip.width - text_.width(line, size)) / 2,
               y + leading + kAscent * size, line, size, first ? kInk : kPaleInk);
    y += sizes.line(size);
    first = false;
  }
}

}  // namespace springlod::render
