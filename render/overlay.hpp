#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/text.hpp"

namespace springlod::render {

/// A bar of colours with numbers below it.
struct ColourScale {
  struct Tick {
    double part = 0;  ///< where along the bar, 0..1
    std::string text;
    bool operator==(const Tick&) const = default;
  };
  std::string name;
  Colour (*colour)(double part) = nullptr;
  std::vector<Tick> ticks;  ///< from left to right
  double bar_share = 0.2;   ///< of the panel's width
  bool operator==(const ColourScale&) const = default;
};

/// What is written on one panel.
struct PanelLabels {
  std::string title;
  std::vector<std::string> captions;
  std::vector<ColourScale> scales;     ///< bottom right, from the lowest up
  std::optional<double> grid_spacing;  ///< [m]: written small, as the scale of the floor
};

/// Part of a panel's height that its title and `captions` lines below it take.
double heading_share(int panel_height, std::size_t captions);
/// Part of a panel's height that a colour scale takes.
double scale_share(int panel_height);

/// Writes labels, colour scales and dividers on pictures, after they were drawn.
class Overlay {
 public:
  void draw_panel(Image& image, const PixelRect& panel, const PanelLabels& labels);
  /// Bottom centre of the whole picture.
  void draw_footer(Image& image, const std::string& text);
  /// Thin lines between panels of one size.
  static void draw_dividers(Image& image, const PixelRect& first_panel);
  /// Height of the strip above the panels that the picture's title takes; 0 without a title.
  static int title_height(const std::string& title, int panel_height);
  /// The title in its strip, centred; lines after the first are smaller.
  void draw_title(Image& image, const std::string& title, int panel_height);

 private:
  void draw_heading(Image& image, const PixelRect& panel, const PanelLabels& labels);
  /// Lower edge at `bottom` [px]; returns the upper edge.
  int draw_scale(Image& image, const PixelRect& panel, const ColourScale& scale, int bottom);
  TextPainter text_;
};

}  // namespace springlod::render
