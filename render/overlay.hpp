#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/text.hpp"

namespace springlod::render {

/// A colour bar with numbers below it.
struct ColourScale {
  struct Tick {
    double part = 0;  ///< position along the bar, 0..1
    std::string text;
    bool operator==(const Tick&) const = default;
  };
  std::string name;
  Colour (*colour)(double part) = nullptr;
  std::vector<Tick> ticks;  ///< from left to right
  double bar_share = 0.2;   ///< width of the bar / width of the panel
  bool operator==(const ColourScale&) const = default;
};

/// The labels of one panel.
struct PanelLabels {
  std::string title;
  std::vector<std::string> captions;
  std::vector<ColourScale> scales;     ///< bottom right, stacked upwards
  std::optional<double> grid_spacing;  ///< scale of the floor [m], written small
  bool anchors = false;                ///< explains the mark of anchored nodes
};

/// Fraction of a panel's height taken by its title and `captions` lines below it.
double heading_share(int panel_height, std::size_t captions);
/// Fraction of a panel's height taken by a colour scale.
double scale_share(int panel_height);
/// Fraction of the height of a picture of one row taken by its footer.
double footer_share(int panel_height);

/// Fractions of a panel's height kept free for labels.
struct LabelRoom {
  double above = 0;
  double below = 0;
};
/// Labels that would fill more than half of a very small panel get half of it.
LabelRoom room_beside_labels(double above, double below);

/// Draws labels, colour scales and dividers on finished images.
class Overlay {
 public:
  void draw_panel(Image& image, const PixelRect& panel, const PanelLabels& labels);
  /// Draws a line of text at the bottom centre of the image, in the size of the panels' titles.
  void draw_footer(Image& image, const std::string& text, int panel_height);
  /// Draws thin lines between panels of equal size.
  static void draw_dividers(Image& image, const PixelRect& first_panel);
  /// Height of the title strip above the panels [px]; 0 without a title.
  static int title_height(const std::string& title, int panel_height);
  /// Draws the title centred in its strip; lines after the first are smaller.
  void draw_title(Image& image, const std::string& title, int panel_height);

 private:
  void draw_heading(Image& image, const PixelRect& panel, const PanelLabels& labels);
  /// Lower edge at `bottom` [px]; returns the upper edge.
  int draw_scale(Image& image, const PixelRect& panel, const ColourScale& scale, int bottom);
  TextPainter text_;
};

}  // namespace springlod::render
