#include "render/scene.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

#include "model/error.hpp"
#include "render/camera.hpp"
#include "render/drawables.hpp"
#include "render/overlay.hpp"
#include "render/pipeline.hpp"
#include "render/plane.hpp"

namespace springlod {
namespace {

void validate(const Camera& camera) {
  if (!camera.eye.allFinite() || !camera.target.allFinite() || !camera.up.allFinite() ||
      !((camera.eye - camera.target).norm() > 0) || !(camera.up.norm() > 0) ||
      !(camera.fov_degrees > 0 && camera.fov_degrees < 180))
    throw InputError(
        "camera: eye and target must be finite and apart, up not zero, the field of view between 0 "
        "and 180 deg");
}

PanelLabels labels_of(const Panel& panel) {
  PanelLabels labels{panel.title, panel.captions, {}, {}};
  for (const DrawnBody& body : panel.bodies)
    if (body.style.springs && body.style.spring_colour == SpringColour::strain)
      labels.strain_range = body.style.strain_range;
  if (!panel.planes.empty()) labels.grid_spacing = grid_spacing(view_radius(panel.camera));
  return labels;
}

/// What all panels share is written once, in the outer corners: the scale of the grid on the first
/// panel, that of the strain on the last. There the footer never covers it.
std::vector<PanelLabels> labels_of(const std::vector<Panel>& panels) {
  std::vector<PanelLabels> labels;
  for (const Panel& panel : panels) labels.push_back(labels_of(panel));
  for (std::size_t i = 1; i < labels.size(); ++i)
    if (labels[i].grid_spacing == labels.front().grid_spacing) labels[i].grid_spacing.reset();
  for (std::size_t i = 0; i + 1 < labels.size(); ++i)
    if (labels[i].strain_range == labels.back().strain_range) labels[i].strain_range.reset();
  return labels;
}

void copy_into(Image& whole, const Image& part, std::size_t x) {
  const std::size_t row = std::size_t{3} * part.width;
  for (std::size_t y = 0; y < part.height; ++y)
    std::copy_n(part.rgb.begin() + static_cast<std::ptrdiff_t>(y * row), row,
                whole.rgb.begin() + static_cast<std::ptrdiff_t>(3 * (y * whole.width + x)));
}

}  // namespace

struct Renderer::Impl {
  std::uint32_t panel_count;
  OffscreenContext context;  // of one panel: equal panels come out equal, whatever their place
  Pipeline pipeline{context};
  Overlay overlay;

  Impl(std::uint32_t width, std::uint32_t height, std::uint32_t count)
      : panel_count(count), context(width, height) {}
};

Renderer::Renderer(std::uint32_t panel_width, std::uint32_t panel_height,
                   std::uint32_t panel_count) {
  // The widest picture that other programs open without trouble; also keeps sizes far from
  // overflow.
  constexpr std::uint32_t kWidest = 16384;
  if (panel_count == 0 || panel_width > kWidest || panel_count > kWidest ||
      panel_width * panel_count > kWidest)
    throw InputError(
        fmt::format("picture: {} panels of {} pixels cannot be drawn; together 1 to {} are allowed",
                    panel_count, panel_width, kWidest));
  impl_ = std::make_unique<Impl>(panel_width, panel_height, panel_count);
}

Renderer::~Renderer() = default;

Image Renderer::draw(const std::vector<Panel>& panels, const std::string& footer) {
  Impl& im = *impl_;
  if (panels.size() != im.panel_count)
    throw InputError(
        fmt::format("drawing: {} panels given to a picture of {}", panels.size(), im.panel_count));
  for (const Panel& panel : panels) {
    validate(panel.camera);
    for (const DrawnBody& body : panel.bodies) springlod::validate(body);
  }
  const std::uint32_t width = im.context.width();
  const std::uint32_t height = im.context.height();
  Image picture{width * im.panel_count, height, {}};
  picture.rgb.resize(std::size_t{3} * picture.width * height);
  const std::vector<PanelLabels> labels = labels_of(panels);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    im.pipeline.draw(panels[i]);
    copy_into(picture, im.context.finish(), i * width);
    const PixelRect place{static_cast<int>(i * width), 0, static_cast<int>(width),
                          static_cast<int>(height)};
    im.overlay.draw_panel(picture, place, labels[i]);
  }
  Overlay::draw_dividers(picture, static_cast<int>(width));
  im.overlay.draw_footer(picture, footer);
  return picture;
}

}  // namespace springlod
