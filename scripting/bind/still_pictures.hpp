#pragma once

#include <memory>
#include <vector>

#include "render/scene.hpp"

namespace springlod {

/// Draws the still pictures of a session. Context and shaders are kept from one to the next where
/// their panels have one size.
class StillPictures {
 public:
  /// Throws as Renderer does.
  Image draw(const PanelGrid& grid, std::vector<Panel> panels, const PictureText& text);

 private:
  std::unique_ptr<Renderer> renderer_;  // of the last picture, if it is worth its memory
};

}  // namespace springlod
