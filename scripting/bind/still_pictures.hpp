#pragma once

#include <memory>
#include <vector>

#include "render/scene.hpp"

namespace springlod::scripting {

/// Draws the still pictures of a session. Context and shaders are kept from one to the next where
/// their panels have one size.
class StillPictures {
 public:
  /// Throws as Renderer does.
  render::Image draw(const render::PanelGrid& grid, std::vector<render::Panel> panels,
                     const render::PictureText& text);

 private:
  std::unique_ptr<render::Renderer> renderer_;  // of the last picture, if it is worth its memory
};

}  // namespace springlod::scripting
