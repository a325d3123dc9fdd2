#pragma once

#include <memory>
#include <vector>

#include "render/scene.hpp"

namespace springlod::scripting {

/// Draws the still pictures of a session. Consecutive pictures with panels of the same size share
/// context and shaders.
class StillPictures {
 public:
  /// Throws as Renderer does.
  render::Image draw(const render::PanelGrid& grid, std::vector<render::Panel> panels,
                     const render::PictureText& text);

 private:
  std::unique_ptr<render::Renderer> renderer_;  // of the last picture, if it is worth its memory
};

}  // namespace springlod::scripting
