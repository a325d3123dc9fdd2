#pragma once

#include <vector>

#include "render/scene.hpp"
#include "render/text.hpp"

namespace springlod::render {

/// Radius of the mark of an anchored node where marks do not touch [px].
double anchor_mark_radius(const PixelRect& panel);

/// Draws the mark of an anchored node, a dark dot with a white rim, clipped to `clip`.
void draw_anchor_mark(Image& image, const PixelRect& clip, double x, double y, double radius);

/// True if a body of the panel has anchored nodes that are to be marked.
bool marks_anchors(const Panel& panel);

/// Marks the anchored nodes of a panel on its finished image. Surfaces do not hide the marks: nodes
/// may lie inside.
void mark_anchors(Image& image, const PixelRect& place, const Panel& panel);

}  // namespace springlod::render
