#include "render/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "base/error.hpp"
#include "render/anchor_marks.hpp"
#include "render/camera.hpp"
#include "render/drawables.hpp"
#include "render/node_values.hpp"
#include "render/overlay.hpp"
#include "render/pipeline.hpp"
#include "render/plane.hpp"
#include "render/strain_colour.hpp"
#include "render/value_colour.hpp"

namespace springlod::render {
namespace {

void validate(const Camera& camera) {
  if (!camera.eye.allFinite() || !camera.target.allFinite() || !camera.up.allFinite() ||
      !((camera.eye - camera.target).norm() > 0) || !(camera.up.norm() > 0) ||
      !(camera.fov_degrees > 0 && camera.fov_degrees < 180))
    throw InputError(
        "camera: eye and target must be finite and different, up not zero, the field of view "
        "between 0 "
        "and 180 deg");
}

ColourScale strain_scale(double range) {
  return {.name = "strain",
          .colour = [](double part) { return strain_colour(2 * part - 1); },
          .ticks = {{0, fmt::format("\u2212{:.3g} %", range * 100)},
                    {0.5, "0"},
                    {1, fmt::format("+{:.3g} %", range * 100)}}};
}

/// Three significant digits; thousands without exponent, "1000" instead of "1e+03".
std::string tick_text(double value) {
  const double size = std::abs(value);
  return size >= 999.5 && size < 1e6 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

ColourScale colour_scale(const ValueScale& scale) {
  ColourScale shown{.name = scale.label, .colour = value_colour, .ticks = {}, .bar_share = 0.28};
  const auto tick = [&](double part, double value) {
    shown.ticks.push_back({part, tick_text(value / scale.unit)});
  };
  if (!(scale.high > scale.low)) {
    tick(0.5, scale.low);
  } else {
    for (const double part : {0., 0.5, 1.}) tick(part, scale.value(part));
  }
  return shown;
}

PanelLabels labels_of(const Panel& panel, const std::optional<ValueScale>& values) {
  PanelLabels labels{panel.title, panel.captions, {}, {}, marks_anchors(panel)};
  if (values) labels.scales.push_back(colour_scale(*values));
  for (const DrawnBody& body : panel.bodies)
    if (body.style.springs && body.style.spring_colour == SpringColour::strain) {
      labels.scales.push_back(strain_scale(body.style.strain_range));
      break;
    }
  if (!panel.planes.empty()) labels.grid_spacing = grid_spacing(view_radius(panel.camera));
  return labels;
}

/// Shared scales are written once, in the outer corners, where the footer cannot cover them: the
/// grid scale on the first panel, the anchor mark on the first that has marks, colour scales on the
/// last panel that uses them.
std::vector<PanelLabels> labels_of(const std::vector<Panel>& panels,
                                   const std::vector<std::optional<ValueScale>>& values) {
  std::vector<PanelLabels> labels;
  for (std::size_t i = 0; i < panels.size(); ++i) labels.push_back(labels_of(panels[i], values[i]));
  for (std::size_t i = 1; i < labels.size(); ++i)
    if (labels[i].grid_spacing == labels.front().grid_spacing) labels[i].grid_spacing.reset();
  bool explained = false;
  for (PanelLabels& of_panel : labels) {
    of_panel.anchors = of_panel.anchors && !explained;
    explained = explained || of_panel.anchors;
  }
  for (std::size_t i = 0; i < labels.size(); ++i)
    std::erase_if(labels[i].scales, [&](const ColourScale& scale) {
      return std::any_of(labels.begin() + static_cast<std::ptrdiff_t>(i) + 1, labels.end(),
                         [&](const PanelLabels& later) {
                           return std::find(later.scales.begin(), later.scales.end(), scale) !=
                                  later.scales.end();
                         });
    });
  return labels;
}

/// Panels in rows, left to right, below a title of `top` pixels.
struct Layout {
  PanelGrid grid;
  std::uint32_t columns;
  std::uint32_t rows;
  std::uint32_t top = 0;

  explicit Layout(const PanelGrid& of)
      : grid(of),
        columns(of.columns == 0 ? of.panel_count : std::min(of.columns, of.panel_count)),
        rows((of.panel_count + columns - 1) / columns) {}
  PixelRect place(std::size_t panel) const {
    const auto column = static_cast<std::uint32_t>(panel % columns);
    const auto row = static_cast<std::uint32_t>(panel / columns);
    return {static_cast<int>(column * grid.panel_width),
            static_cast<int>(top + row * grid.panel_height), static_cast<int>(grid.panel_width),
            static_cast<int>(grid.panel_height)};
  }
};

/// A white image; places without a panel stay white.
Image blank_image(std::uint32_t width, std::uint32_t height) {
  constexpr std::uint8_t kWhite = 255;
  return {width, height, std::vector<std::uint8_t>(std::size_t{3} * width * height, kWhite)};
}

void copy_into(Image& whole, const Image& part, const PixelRect& place) {
  const std::size_t row = std::size_t{3} * part.width;
  for (std::size_t y = 0; y < part.height; ++y) {
    const std::size_t into =
        (static_cast<std::size_t>(place.y) + y) * whole.width + static_cast<std::size_t>(place.x);
    std::copy_n(part.rgb.begin() + static_cast<std::ptrdiff_t>(y * row), row,
                whole.rgb.begin() + static_cast<std::ptrdiff_t>(3 * into));
  }
}

// Largest side that other programs open without problems; also prevents integer overflow.
constexpr std::uint32_t kLongestSide = 16384;

void require_drawable(const PanelGrid& grid) {
  const auto too_large = [](std::uint64_t pixels, std::uint64_t count) {
    return pixels > kLongestSide || count > kLongestSide || pixels * count > kLongestSide;
  };
  if (grid.panel_count == 0 || grid.panel_count > kLongestSide ||
      too_large(grid.panel_width, Layout(grid).columns) ||
      too_large(grid.panel_height, Layout(grid).rows))
    throw InputError(fmt::format(
        "picture: {} panels of {} x {} pixels in {} columns cannot be drawn; total width "
        "and height may be 1 to {}",
        grid.panel_count, grid.panel_width, grid.panel_height,
        grid.columns == 0 ? grid.panel_count : grid.columns, kLongestSide));
}

}  // namespace

struct Renderer::Impl {
  Layout layout;
  OffscreenContext context;  // of the size of one panel
  Pipeline pipeline{context};
  Overlay overlay;

  explicit Impl(const PanelGrid& grid)
      : layout(grid), context(grid.panel_width, grid.panel_height) {}
};

Renderer::Renderer(const PanelGrid& grid) {
  require_drawable(grid);
  impl_ = std::make_unique<Impl>(grid);
}

Renderer::~Renderer() = default;

void Renderer::lay_out(const PanelGrid& grid) {
  require_drawable(grid);
  const PanelGrid& before = impl_->layout.grid;
  if (grid.panel_width == before.panel_width && grid.panel_height == before.panel_height)
    impl_->layout = Layout(grid);
  else
    impl_ = std::make_unique<Impl>(grid);
}

Image Renderer::draw(std::vector<Panel> panels, const PictureText& text) {
  Impl& im = *impl_;
  const PanelGrid& grid = im.layout.grid;
  if (panels.size() != grid.panel_count)
    throw InputError(fmt::format("drawing: {} panels given for a layout of {}", panels.size(),
                                 grid.panel_count));
  for (const Panel& panel : panels) {
    validate(panel.camera);
    for (const DrawnBody& body : panel.bodies) render::validate(body);
  }
  const std::vector<PanelLabels> labels = labels_of(panels, colour_by_values(panels));
  Layout layout = im.layout;
  const int panel_height = static_cast<int>(grid.panel_height);
  layout.top = static_cast<std::uint32_t>(Overlay::title_height(text.title, panel_height));
  Image picture =
      blank_image(layout.columns * grid.panel_width, layout.top + layout.rows * grid.panel_height);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const PixelRect place = layout.place(i);
    im.pipeline.draw(panels[i]);
    copy_into(picture, im.context.finish(), place);
    mark_anchors(picture, place, panels[i]);
    im.overlay.draw_panel(picture, place, labels[i]);
  }
  if (layout.top > 0) im.overlay.draw_title(picture, text.title, panel_height);
  Overlay::draw_dividers(picture, layout.place(0));
  im.overlay.draw_footer(picture, text.footer, panel_height);
  return picture;
}

}  // namespace springlod::render
