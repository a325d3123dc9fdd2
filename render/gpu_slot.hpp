#pragma once

#include <cstddef>
#include <vector>

#include "render/cut.hpp"
#include "render/drawables.hpp"
#include "render/gl.hpp"

namespace springlod::render {

/// Vertex buffer and layout of one kind of primitive in one panel.
template <typename Record>
struct Stream {
  GlVertexArray layout = make_vertex_array();
  GlBuffer buffer = make_buffer();
  GLsizei count = 0;

  void set(const std::vector<Record>& records) {
    upload(GL_ARRAY_BUFFER, buffer, records);
    count = static_cast<GLsizei>(records.size());
  }
  /// A record consists of consecutive attributes of `widths` floats each.
  void describe(const std::vector<GLint>& widths, bool per_instance) {
    glBindVertexArray(layout.name());
    glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
    std::size_t offset = 0;
    for (GLuint i = 0; i < widths.size(); ++i) {
      float_attribute(i, widths[i], sizeof(Record) / sizeof(float), offset, per_instance);
      offset += static_cast<std::size_t>(widths[i]);
    }
  }
};

/// Draws the records of a stream as instances of a quad.
template <typename Record>
void draw_quads(const Stream<Record>& stream) {
  if (stream.count == 0) return;
  glBindVertexArray(stream.layout.name());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, stream.count);
}

struct CachedSurface {
  SplitSurface split;
  GlBuffer indices = make_buffer();
};

/// GPU buffers of one body or box; slots are reused from panel to panel.
struct Slot {
  Stream<SurfaceVertex> vertices;
  Stream<SpringInstance> springs;
  Stream<NodeInstance> nodes;
  bool cut = false;
  /// Plane of the cut face, its normal out of the body; zero: no face is drawn.
  Eigen::Vector4f cap = Eigen::Vector4f::Zero();
  std::vector<CutPart> cut_parts;  // with a face
  Vec3f middle = Vec3f::Zero();    // of the body, and a radius around it that contains it [m]
  float reach = 0;
  const CachedSurface* surface = nullptr;  // null: no surface is drawn
  float opacity = 1;
  double distance = 0;  // from its middle to the eye

  Slot() {
    vertices.describe({3, 3, 3, 1}, false);
    springs.describe({3, 3, 3, 3, 1}, true);
    nodes.describe({3, 3, 1}, true);
  }
};

/// Draws some triangles of a slot's surface, clipped at its cut.
inline void draw_triangles(const Slot& slot, std::size_t first, std::size_t count) {
  if (slot.cut) glEnable(GL_CLIP_DISTANCE0);
  glBindVertexArray(slot.vertices.layout.name());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, slot.surface->indices.name());
  // The last argument is an offset [bytes], which OpenGL takes as a pointer.
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * count), GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(first * sizeof(Triangle)));
  glDisable(GL_CLIP_DISTANCE0);
}

}  // namespace springlod::render
