#include "scripting/bind/tables/still_pictures.hpp"

#include <cstdint>
#include <utility>

namespace springlod::scripting {

namespace {

// Largest panel whose context is kept [px]: 200 MB at about 50 bytes per pixel.
constexpr std::uint64_t kMostPixels = 4'000'000;

}  // namespace

render::Image StillPictures::draw(const render::PanelGrid& grid, std::vector<render::Panel> panels,
                                  const render::PictureText& text) {
  if (renderer_)
    renderer_->lay_out(grid);
  else
    renderer_ = std::make_unique<render::Renderer>(grid);
  render::Image picture = renderer_->draw(std::move(panels), text);
  if (std::uint64_t{grid.panel_width} * grid.panel_height > kMostPixels) renderer_.reset();
  return picture;
}

}  // namespace springlod::scripting
