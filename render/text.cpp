#include "render/text.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <tuple>
#include <vector>

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#include <stb/stb_truetype.h>

#include "base/error.hpp"
#include "render/font_data.hpp"

namespace springlod::render {
namespace {

constexpr char32_t kReplacement = 0xFFFD;

// Next code point of UTF-8 text; each invalid byte gives the replacement character.
char32_t next_code_point(std::string_view text, std::size_t& at) {
  const auto lead = static_cast<unsigned char>(text[at++]);
  if (lead < 0x80) return lead;
  const int more = lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : 1;
  if (lead < 0xC2 || lead > 0xF4 || at + static_cast<std::size_t>(more) > text.size())
    return kReplacement;
  char32_t code = lead & (0x3FU >> more);
  for (int i = 0; i < more; ++i) {
    const auto byte = static_cast<unsigned char>(text[at + static_cast<std::size_t>(i)]);
    if ((byte & 0xC0U) != 0x80) return kReplacement;
    code = code << 6U | (byte & 0x3FU);
  }
  at += static_cast<std::size_t>(more);
  return code;
}

std::vector<char32_t> code_points(std::string_view text) {
  std::vector<char32_t> codes;
  for (std::size_t at = 0; at < text.size();) codes.push_back(next_code_point(text, at));
  return codes;
}

struct Letter {
  int left = 0, top = 0, width = 0, height = 0;
  std::vector<unsigned char> cover;
};

// Glyphs are rasterized at quarter-pixel offsets for even spacing.
constexpr int kPhases = 4;

}  // namespace

struct TextPainter::Impl {
  stbtt_fontinfo font{};
  std::map<std::tuple<int, int, int>, Letter> letters;  // glyph, size in 1/16 px, phase

  double scale(double size) const {
    return static_cast<double>(stbtt_ScaleForPixelHeight(&font, static_cast<float>(size)));
  }

  // Glyph indices and start positions from 0; the last entry of `x` is the width.
  void lay_out(std::string_view text, double size, std::vector<int>& glyphs,
               std::vector<double>& x) const {
    const double s = scale(size);
    glyphs.clear();
    x.assign(1, 0);
    for (const char32_t code : code_points(text)) {
      const int glyph = stbtt_FindGlyphIndex(&font, static_cast<int>(code));
      if (!glyphs.empty()) x.back() += s * stbtt_GetGlyphKernAdvance(&font, glyphs.back(), glyph);
      int advance = 0;
      stbtt_GetGlyphHMetrics(&font, glyph, &advance, nullptr);
      glyphs.push_back(glyph);
      x.push_back(x.back() + s * advance);
    }
  }

  const Letter& letter(int glyph, double size, int phase) {
    const auto key = std::tuple(glyph, static_cast<int>(std::lround(size * 16)), phase);
    const auto [at, fresh] = letters.try_emplace(key);
    Letter& l = at->second;
    if (!fresh) return l;
    const auto s = static_cast<float>(scale(size));
    const float shift = static_cast<float>(phase) / kPhases;
    int x1 = 0;
    int y1 = 0;
    stbtt_GetGlyphBitmapBoxSubpixel(&font, glyph, s, s, shift, 0, &l.left, &l.top, &x1, &y1);
    l.width = x1 - l.left;
    l.height = y1 - l.top;
    if (l.width <= 0 || l.height <= 0) return l;  // a space
    l.cover.resize(static_cast<std::size_t>(l.width) * static_cast<std::size_t>(l.height));
    stbtt_MakeGlyphBitmapSubpixel(&font, l.cover.data(), l.width, l.height, l.width, s, s, shift, 0,
                                  glyph);
    return l;
  }
};

TextPainter::TextPainter() : impl_(std::make_unique<Impl>()) {
  if (stbtt_InitFont(&impl_->font, font_file(), 0) == 0)
    throw Error("the label font inside the program cannot be read; build it again");
}
TextPainter::~TextPainter() = default;

double TextPainter::width(std::string_view text, double size) const {
  std::vector<int> glyphs;
  std::vector<double> x;
  impl_->lay_out(text, size, glyphs, x);
  return x.back();
}

std::string TextPainter::fitted(std::string_view text, double size, double room) const {
  if (width(text, size) <= room) return std::string(text);
  for (std::size_t keep = text.size(); keep > 0; --keep) {
    // Cut only between characters: a byte 10xxxxxx continues the one before.
    if (keep < text.size() && (static_cast<unsigned char>(text[keep]) & 0xC0U) == 0x80) continue;
    std::string shorter = std::string(text.substr(0, keep)) + "\u2026";
    if (width(shorter, size) <= room) return shorter;
  }
  return "";
}

void TextPainter::draw(Image& image, const PixelRect& clip, double x, double baseline,
                       std::string_view text, double size, const Colour& colour) {
  std::vector<int> glyphs;
  std::vector<double> offsets;
  impl_->lay_out(text, size, glyphs, offsets);
  const int y0 = static_cast<int>(std::lround(baseline));
  for (std::size_t i = 0; i < glyphs.size(); ++i) {
    const auto quarter = static_cast<int>(std::floor((x + offsets[i]) * kPhases));
    const int x0 = static_cast<int>(std::floor(static_cast<double>(quarter) / kPhases));
    const Letter& l = impl_->letter(glyphs[i], size, quarter - x0 * kPhases);
    for (int row = 0; row < l.height; ++row)
      for (int column = 0; column < l.width; ++column) {
        const int px = x0 + l.left + column;
        const int py = y0 + l.top + row;
        if (px < clip.x || px >= clip.x + clip.width || py < clip.y || py >= clip.y + clip.height)
          continue;
        const auto cover =
            l.cover[static_cast<std::size_t>(row) * static_cast<std::size_t>(l.width) +
                    static_cast<std::size_t>(column)];
        if (cover != 0) blend_pixel(image, px, py, colour, cover / 255.);
      }
  }
}

void blend_pixel(Image& image, int x, int y, const Colour& colour, double alpha) {
  if (x < 0 || y < 0 || x >= static_cast<int>(image.width) || y >= static_cast<int>(image.height))
    return;
  std::uint8_t* p = image.rgb.data() +
                    3 * (static_cast<std::size_t>(y) * image.width + static_cast<std::size_t>(x));
  const double channels[3] = {static_cast<double>(colour.r), static_cast<double>(colour.g),
                              static_cast<double>(colour.b)};
  for (int c = 0; c < 3; ++c)
    p[c] = static_cast<std::uint8_t>(
        std::lround(p[c] + alpha * (255 * std::clamp(channels[c], 0., 1.) - p[c])));
}

void fill_rounded(Image& image, const PixelRect& rect, double corner_radius, const Colour& colour,
                  double alpha) {
  const double radius = std::min({corner_radius, rect.width / 2., rect.height / 2.});
  for (int y = 0; y < rect.height; ++y)
    for (int x = 0; x < rect.width; ++x) {
      // Distance of the pixel centre from the rectangle shrunk by the radius.
      const double dx = std::max({radius - (x + 0.5), x + 0.5 - (rect.width - radius), 0.});
      const double dy = std::max({radius - (y + 0.5), y + 0.5 - (rect.height - radius), 0.});
      const double cover = std::clamp(radius - std::hypot(dx, dy) + 0.5, 0., 1.);
      if (cover > 0) blend_pixel(image, rect.x + x, rect.y + y, colour, alpha * cover);
    }
}

}  // namespace springlod::render
