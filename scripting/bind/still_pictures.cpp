#include "scripting/bind/still_pictures.hpp"

#include <cstdint>
#include <utility>

namespace springlod {

namespace {

// Of a panel whose context is kept: at some 50 bytes a pixel, 200 MB.
constexpr std::uint64_t kMostPixels = 4'000'000;

}  // namespace

Image StillPictures::draw(const PanelGrid& grid, std::vector<Panel> panels,
                          const PictureText& text) {
  if (renderer_)
    renderer_->lay_out(grid);
  else
    renderer_ = std::make_unique<Renderer>(grid);
  Image picture = renderer_->draw(std::move(panels), text);
  if (std::uint64_t{grid.panel_width} * grid.panel_height > kMostPixels) renderer_.reset();
  return picture;
}

}  // namespace springlod
