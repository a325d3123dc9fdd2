#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "model/material.hpp"
#include "render/context.hpp"

namespace springlod::render {

/// A rectangle of an image [px]; the origin is at the top left.
struct PixelRect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// Draws antialiased UTF-8 text into images. Caches rasterized glyphs.
class TextPainter {
 public:
  TextPainter();
  ~TextPainter();
  TextPainter(const TextPainter&) = delete;
  TextPainter& operator=(const TextPainter&) = delete;

  /// Width of one line [px]; `size`: font size [px].
  double width(std::string_view text, double size) const;
  /// `text`, shortened with an ellipsis if it is wider than `room` [px].
  std::string fitted(std::string_view text, double size, double room) const;
  /// Draws from (x, baseline), clipped to `clip`.
  void draw(Image& image, const PixelRect& clip, double x, double baseline, std::string_view text,
            double size, const Colour& colour);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Blends `colour` over a rectangle with rounded corners; `alpha` 0..1.
void fill_rounded(Image& image, const PixelRect& rect, double corner_radius, const Colour& colour,
                  double alpha);

/// Blends `colour` over one pixel.
void blend_pixel(Image& image, int x, int y, const Colour& colour, double alpha);

}  // namespace springlod::render
