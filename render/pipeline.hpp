#pragma once

#include <memory>

#include "render/scene.hpp"

namespace springlod::render {

/// Draws one panel into the current target of `context`: shadow map, backdrop, planes, boxes,
/// opaque bodies, then transparent ones. Caches shaders, buffers and split surfaces between panels.
class Pipeline {
 public:
  explicit Pipeline(OffscreenContext& context);
  ~Pipeline();
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;
  void draw(const Panel& panel);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace springlod::render
