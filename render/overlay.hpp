#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/text.hpp"

namespace springlod {

/// What is written on one panel.
struct PanelLabels {
  std::string title;
  std::vector<std::string> captions;
  std::optional<double> strain_range;  ///< draws the colour scale of the strain
  std::optional<double> grid_spacing;  ///< [m]: written small, as the scale of the floor
};

/// Writes labels, colour scales and dividers on pictures, after they were drawn.
class Overlay {
 public:
  void draw_panel(Image& image, const PixelRect& panel, const PanelLabels& labels);
  /// Bottom centre of the whole picture.
  void draw_footer(Image& image, const std::string& text);
  /// Thin lines between panels of one width.
  static void draw_dividers(Image& image, int panel_width);

 private:
  void draw_heading(Image& image, const PixelRect& panel, const PanelLabels& labels);
  void draw_scale(Image& image, const PixelRect& panel, double range);
  TextPainter text_;
};

}  // namespace springlod
