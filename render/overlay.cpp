#include "render/overlay.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "render/strain_colour.hpp"

namespace springlod {
namespace {

constexpr Colour kInk{0.13F, 0.15F, 0.18F};
constexpr Colour kPaleInk{0.33F, 0.36F, 0.40F};
constexpr Colour kPlate{1, 1, 1};
constexpr Colour kDivider{0.62F, 0.65F, 0.69F};
constexpr double kPlateAlpha = 0.72;

/// Sizes that follow the picture's height [px].
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

// DejaVu's letters reach about this part of their box above the baseline.
constexpr double kAscent = 0.80;

int whole(double v) {
  return static_cast<int>(std::lround(v));
}

std::string length_text(double metres) {
  if (metres >= 1000) return fmt::format("{:g} km", metres / 1000);
  if (metres >= 1) return fmt::format("{:g} m", metres);
  if (metres >= 0.01) return fmt::format("{:g} cm", metres * 100);
  if (metres >= 0.001) return fmt::format("{:g} mm", metres * 1000);
  return fmt::format("{:g} um", metres * 1e6);
}

}  // namespace

void Overlay::draw_heading(Image& image, const PixelRect& panel, const PanelLabels& labels) {
  const Sizes sizes(panel.height);
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

void Overlay::draw_scale(Image& image, const PixelRect& panel, double range) {
  const Sizes sizes(panel.height);
  const std::string low = fmt::format("\u2212{:.3g} %", range * 100);
  const std::string high = fmt::format("+{:.3g} %", range * 100);
  const std::string name = "strain";
  const int bar = whole(panel.width * 0.20);
  const int thick = whole(sizes.small * 0.55);
  const double half_low = text_.width(low, sizes.small) / 2;
  const double half_high = text_.width(high, sizes.small) / 2;
  const int width = bar + whole(half_low + half_high + 2 * sizes.pad);
  const int height = whole(2 * sizes.line(sizes.small) + thick + 1.6 * sizes.pad);
  // Above the line of the footer, which may be centred right beside it.
  const int bottom = panel.y + panel.height - whole(sizes.margin);
  const PixelRect plate{panel.x + panel.width - whole(sizes.margin) - width, bottom - height, width,
                        height};
  fill_rounded(image, plate, sizes.pad, kPlate, kPlateAlpha);
  const int x0 = plate.x + whole(sizes.pad + half_low);
  const double name_base = plate.y + 0.7 * sizes.pad + kAscent * sizes.small;
  const int y0 = plate.y + whole(0.8 * sizes.pad + sizes.line(sizes.small));
  for (int x = 0; x < bar; ++x) {
    const Colour colour = strain_colour(2 * (x + 0.5) / bar - 1);
    for (int y = 0; y < thick; ++y) blend_pixel(image, x0 + x, y0 + y, colour, 1);
  }
  const double ticks = y0 + thick + 0.2 * sizes.pad + kAscent * sizes.small + 1;
  text_.draw(image, panel, x0 + (bar - text_.width(name, sizes.small)) / 2, name_base, name,
             sizes.small, kInk);
  text_.draw(image, panel, x0 - half_low, ticks, low, sizes.small, kPaleInk);
  text_.draw(image, panel, x0 + (bar - text_.width("0", sizes.small)) / 2, ticks, "0", sizes.small,
             kPaleInk);
  text_.draw(image, panel, x0 + bar - half_high, ticks, high, sizes.small, kPaleInk);
}

void Overlay::draw_panel(Image& image, const PixelRect& panel, const PanelLabels& labels) {
  const Sizes sizes(panel.height);
  draw_heading(image, panel, labels);
  if (labels.strain_range) draw_scale(image, panel, *labels.strain_range);
  if (labels.grid_spacing) {
    const std::string text = "grid " + length_text(*labels.grid_spacing);
    text_.draw(image, panel, panel.x + sizes.margin + sizes.pad,
               panel.y + panel.height - sizes.margin - 0.4 * sizes.pad, text, sizes.small,
               kPaleInk);
  }
}

void Overlay::draw_footer(Image& image, const std::string& text) {
  if (text.empty()) return;
  const PixelRect all{0, 0, static_cast<int>(image.width), static_cast<int>(image.height)};
  const Sizes sizes(all.height);
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

void Overlay::draw_dividers(Image& image, int panel_width) {
  constexpr int kThick = 2;  // [px]
  for (int x = panel_width; x < static_cast<int>(image.width); x += panel_width)
    for (int y = 0; y < static_cast<int>(image.height); ++y)
      for (int i = -kThick / 2; i < kThick - kThick / 2; ++i)
        blend_pixel(image, x + i, y, kDivider, 1);
}

}  // namespace springlod
