#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "model/material.hpp"
#include "render/context.hpp"

namespace springlod::render {

/// Part of a picture [px], from the top left.
struct PixelRect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// Writes antialiased UTF-8 text into pictures. Keeps rasterised letters.
class TextPainter {
 public:
  TextPainter();
  ~TextPainter();
  TextPainter(const TextPainter&) = delete;
  TextPainter& operator=(const TextPainter&) = delete;

  /// Width of one line [px]; `size`: height of the letters' box [px].
  double width(std::string_view text, double size) const;
  /// `text`, shortened with an ellipsis if it is wider than `room` [px].
  std::string fitted(std::string_view text, double size, double room) const;
  /// From (x, baseline); parts outside `clip` are left out.
  void draw(Image& image, const PixelRect& clip, double x, double baseline, std::string_view text,
            double size, const Colour& colour);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Lays `colour` over the rectangle with rounded corners; `alpha` 0..1.
void fill_rounded(Image& image, const PixelRect& rect, double corner_radius, const Colour& colour,
                  double alpha);

/// One pixel mixed towards `colour`.
void blend_pixel(Image& image, int x, int y, const Colour& colour, double alpha);

}  // namespace springlod::render
