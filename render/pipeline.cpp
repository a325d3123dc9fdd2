#include "render/pipeline.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string_view>

#include "base/file.hpp"
#include "render/camera.hpp"
#include "render/drawables.hpp"
#include "render/gl.hpp"
#include "render/light.hpp"
#include "render/plane.hpp"
#include "render/shaders.hpp"
#include "render/shadow_map.hpp"

namespace springlod::render {
namespace {

using Vec4f = Eigen::Vector4f;

/// The uniform block of the shaders in std140 layout; only 16-byte members, hence no padding.
struct FrameUniforms {
  Mat4f view_projection;
  Mat4f shadow_projection;
  Vec4f eye;
  Vec4f key_light;
  Vec4f world_up;
  Vec4f camera_right;
  Vec4f shadow_size;
  Vec4f pixel;
};

GlProgram program(const char* name, const ShaderSource& source) {
  GlProgram made = make_program(name, source.vertex, source.fragment);
  glUniformBlockBinding(made.name(), glGetUniformBlockIndex(made.name(), "Frame"), 0);
  glUseProgram(made.name());
  glUniform1i(glGetUniformLocation(made.name(), "shadow_compare"), 0);
  glUniform1i(glGetUniformLocation(made.name(), "shadow_depth"), 1);
  return made;
}

GLint uniform(const GlProgram& of, const char* name) {
  return glGetUniformLocation(of.name(), name);
}
void set(const GlProgram& of, const char* name, const Vec3f& v) {
  glUniform3fv(uniform(of, name), 1, v.data());
}
void set(const GlProgram& of, const char* name, float v) {
  glUniform1f(uniform(of, name), v);
}

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

struct CachedSurface {
  SplitSurface split;
  GlBuffer indices = make_buffer();
};

/// GPU buffers of one body or box; slots are reused from panel to panel.
struct Slot {
  Stream<SurfaceVertex> vertices;
  Stream<SpringInstance> springs;
  Stream<NodeInstance> nodes;
  const CachedSurface* surface = nullptr;  // null: no surface is drawn
  float opacity = 1;
  double distance = 0;  // from its middle to the eye

  Slot() {
    vertices.describe({3, 3, 3}, false);
    springs.describe({3, 3, 3, 3, 1}, true);
    nodes.describe({3, 3, 1}, true);
  }
};

template <typename T>
std::string_view bytes_of(const std::vector<T>& items) {
  return {reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T)};
}

// Compares contents, never addresses: a new mesh may have the address of an old one.
std::string surface_key(const TriangleMesh& mesh) {
  std::string key = content_hash(bytes_of(mesh.positions)) + content_hash(bytes_of(mesh.triangles));
  for (const MeshPart& part : mesh.parts)
    key.append(",").append(std::to_string(part.triangle_count));
  return key;
}

constexpr Colour kBoxColour{0.80F, 0.82F, 0.85F};

DrawnBody box_body(const TriangleMesh& mesh) {
  DrawnBody body;
  body.surface = &mesh;
  body.part_colours = {kBoxColour};
  return body;
}

}  // namespace

struct Pipeline::Impl {
  OffscreenContext& context;
  GlBuffer frame_block = make_buffer();
  GlVertexArray no_attributes = make_vertex_array();
  ShadowMap shadow_map;
  GlProgram backdrop = program("backdrop", backdrop_shader());
  GlProgram surface = program("surface", surface_shader());
  GlProgram spring = program("spring", spring_shader());
  GlProgram node = program("node", node_shader());
  GlProgram plane = program("plane", plane_shader());
  GlProgram surface_depth = program("surface depth", surface_depth_shader());
  GlProgram spring_depth = program("spring depth", spring_depth_shader());
  GlProgram node_depth = program("node depth", node_depth_shader());
  std::map<std::string, CachedSurface> surfaces;
  std::vector<Slot> slots;

  explicit Impl(OffscreenContext& of) : context(of) {}

  const CachedSurface& cached(const TriangleMesh& mesh) {
    const auto [at, fresh] = surfaces.try_emplace(surface_key(mesh));
    if (fresh) {
      at->second.split = split_at_creases(mesh);
      glBindVertexArray(0);  // otherwise the buffer would change the layout bound last
      upload(GL_ELEMENT_ARRAY_BUFFER, at->second.indices, at->second.split.triangles);
    }
    return at->second;
  }

  void fill_slot(Slot& slot, const DrawnBody& body, const Camera& camera) {
    const Vec3& origin = camera.target;
    const DrawStyle& style = body.style;
    slot.opacity = static_cast<float>(style.surface_opacity);
    slot.surface = nullptr;
    if (style.surface && body.surface != nullptr && style.surface_opacity > 0) {
      slot.surface = &cached(*body.surface);
      slot.vertices.set(surface_vertices(body, slot.surface->split, origin));
    }
    slot.springs.set(style.springs ? spring_instances(body, origin)
                                   : std::vector<SpringInstance>{});
    slot.nodes.set(draws_balls(style) ? node_instances(body, origin) : std::vector<NodeInstance>{});
    const Box3 box = drawn_bounds(body);
    slot.distance = box.isEmpty() ? 0 : (box.center() - camera.eye).norm();
  }

  /// Fills one slot per body, then one per box; returns the bounds of the shadow casters.
  Box3 fill_slots(const Panel& panel) {
    constexpr std::size_t kSurfacesKept = 32;
    if (surfaces.size() > kSurfacesKept) surfaces.clear();
    slots.resize(panel.bodies.size() + panel.boxes.size());
    Box3 casters;
    for (std::size_t i = 0; i < panel.bodies.size(); ++i) {
      fill_slot(slots[i], panel.bodies[i], panel.camera);
      casters.extend(drawn_bounds(panel.bodies[i]));
    }
    const double bodies_size = casters.isEmpty() ? 0 : casters.diagonal().norm();
    for (std::size_t i = 0; i < panel.boxes.size(); ++i) {
      const TriangleMesh mesh = box_mesh(panel.boxes[i]);
      fill_slot(slots[panel.bodies.size() + i], box_body(mesh), panel.camera);
      // A box far larger than the bodies would reduce their shadows to a few texels, so only its
      // part near them casts shadows.
      constexpr double kLargeBox = 4;
      const Box3 box = bounds(mesh);
      if (casters.isEmpty() || box.diagonal().norm() <= kLargeBox * bodies_size)
        casters.extend(box);
    }
    if (!casters.isEmpty()) casters.translate(-panel.camera.target);
    return casters;
  }

  void set_frame(const FrameUniforms& frame) const {
    glBindBuffer(GL_UNIFORM_BUFFER, frame_block.name());
    glBufferData(GL_UNIFORM_BUFFER, sizeof(FrameUniforms), &frame, GL_STREAM_DRAW);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, frame_block.name());
  }

  static void draw_surface(const Slot& slot) {
    glBindVertexArray(slot.vertices.layout.name());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, slot.surface->indices.name());
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(slot.surface->split.triangles.size() * 3),
                   GL_UNSIGNED_INT, nullptr);
  }

  template <typename Record>
  static void draw_quads(const Stream<Record>& stream) {
    if (stream.count == 0) return;
    glBindVertexArray(stream.layout.name());
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, stream.count);
  }

  static bool opaque(const Slot& slot) { return slot.surface != nullptr && slot.opacity >= 1; }
  static bool transparent(const Slot& slot) { return slot.surface != nullptr && slot.opacity < 1; }

  void draw_shadows(FrameUniforms frame, const KeyLight& light) const {
    frame.view_projection = light.projection;
    frame.eye << light.direction, 0;
    set_frame(frame);
    shadow_map.begin();
    for (const Slot& slot : slots) {
      const bool only_surface = slot.springs.count == 0 && slot.nodes.count == 0;
      glUseProgram(surface_depth.name());
      if (opaque(slot) || (transparent(slot) && only_surface)) draw_surface(slot);
      if (opaque(slot)) continue;  // it hides the rest
      glUseProgram(spring_depth.name());
      draw_quads(slot.springs);
      glUseProgram(node_depth.name());
      draw_quads(slot.nodes);
    }
  }

  void draw_backdrop() const {
    glDisable(GL_DEPTH_TEST);
    glUseProgram(backdrop.name());
    glBindVertexArray(no_attributes.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEnable(GL_DEPTH_TEST);
  }

  void draw_plane(const std::vector<PlanePatch>& patches, std::size_t which, float spacing) const {
    const PlanePatch& patch = patches[which];
    constexpr float kGhost = 0.16F;  // opacity of a wall between the viewer and the bodies
    glUseProgram(plane.name());
    set(plane, "plane_center", patch.center);
    set(plane, "plane_u", patch.u);
    set(plane, "plane_v", patch.v);
    set(plane, "plane_reach", patch.reach);
    set(plane, "plane_colour",
        patch.upright ? Vec3f(0.885F, 0.90F, 0.92F) : Vec3f(0.935F, 0.938F, 0.942F));
    set(plane, "plane_alpha", patch.seen_from_behind ? kGhost : 1.0F);
    set(plane, "grid_spacing", spacing);
    glUniform2fv(uniform(plane, "grid_origin"), 1, patch.grid_origin.data());
    constexpr std::size_t kOthers = 8;  // size of the shader's array
    std::vector<Vec4f> others;
    for (std::size_t i = 0; i < patches.size() && others.size() < kOthers; ++i)
      if (i != which)
        others.emplace_back(patches[i].normal.x(), patches[i].normal.y(), patches[i].normal.z(),
                            patches[i].offset);
    glUniform1i(uniform(plane, "other_count"), static_cast<GLint>(others.size()));
    if (!others.empty())
      glUniform4fv(uniform(plane, "others"), static_cast<GLsizei>(others.size()),
                   others.front().data());
    glBindVertexArray(no_attributes.name());
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }

  void draw_planes(const std::vector<PlanePatch>& patches, float spacing, bool from_behind) const {
    glEnable(GL_BLEND);
    glDepthMask(from_behind ? GL_FALSE : GL_TRUE);
    for (std::size_t i = 0; i < patches.size(); ++i)
      if (patches[i].seen_from_behind == from_behind) draw_plane(patches, i, spacing);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
  }

  void draw_opaque() const {
    for (const Slot& slot : slots) {
      if (opaque(slot)) {
        glUseProgram(surface.name());
        set(surface, "opacity", 1.0F);
        if (slot.surface->split.closed) glEnable(GL_CULL_FACE);
        draw_surface(slot);
        glDisable(GL_CULL_FACE);
      }
      glUseProgram(spring.name());
      draw_quads(slot.springs);
      glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
      glUseProgram(node.name());
      draw_quads(slot.nodes);
      glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
    }
  }

  // Back to front: far bodies first, and of each body the far side before the near side. Exact for
  // convex bodies, a good approximation for others.
  void draw_transparent() const {
    std::vector<const Slot*> order;
    for (const Slot& slot : slots)
      if (transparent(slot)) order.push_back(&slot);
    std::stable_sort(order.begin(), order.end(),
                     [](const Slot* a, const Slot* b) { return a->distance > b->distance; });
    glEnable(GL_BLEND);
    glDepthMask(GL_FALSE);
    glEnable(GL_CULL_FACE);
    glUseProgram(surface.name());
    for (const Slot* slot : order) {
      set(surface, "opacity", slot->opacity);
      for (const GLenum hidden : {GL_FRONT, GL_BACK}) {
        glCullFace(hidden);
        draw_surface(*slot);
      }
    }
    glDisable(GL_CULL_FACE);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
  }

  FrameUniforms frame_uniforms(const Camera& camera, double aspect, const KeyLight& light) const {
    const CameraAxes axes = camera_axes(camera);
    const auto height = static_cast<float>(context.height());
    const double distance = (camera.eye - camera.target).norm();
    FrameUniforms frame;
    frame.view_projection = view_projection(camera, aspect);
    frame.shadow_projection = light.to_unit_cube;
    frame.eye << (camera.eye - camera.target).cast<float>(), 1;
    frame.key_light << light.direction, 0;
    frame.world_up << camera.up.normalized().cast<float>(), 0;
    frame.camera_right << axes.right.cast<float>(), 0;
    frame.shadow_size << light.side, light.depth, light.side / ShadowMap::kSide, 0;
    frame.pixel << static_cast<float>(2 * view_radius(camera) / distance) / height, 0, 0, 0;
    return frame;
  }

  void draw(const Panel& panel) {
    const double aspect = static_cast<double>(context.width()) / context.height();
    context.begin();
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_MULTISAMPLE);
    glCullFace(GL_BACK);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    const KeyLight light = key_light(panel.camera, fill_slots(panel));
    const FrameUniforms frame = frame_uniforms(panel.camera, aspect, light);
    std::vector<PlanePatch> patches;
    for (const DrawnPlane& p : panel.planes)
      patches.push_back(plane_patch(p, panel.camera, aspect));
    const auto spacing = static_cast<float>(grid_spacing(view_radius(panel.camera)));

    draw_shadows(frame, light);
    context.begin();
    set_frame(frame);
    shadow_map.bind();
    glClear(GL_DEPTH_BUFFER_BIT);
    draw_backdrop();
    draw_planes(patches, spacing, false);
    draw_opaque();
    draw_transparent();
    draw_planes(patches, spacing, true);
  }
};

Pipeline::Pipeline(OffscreenContext& context) {
  context.begin();
  impl_ = std::make_unique<Impl>(context);
}

Pipeline::~Pipeline() {
  // The GL objects must be destroyed in the context that created them.
  impl_->context.begin();
}

void Pipeline::draw(const Panel& panel) {
  impl_->draw(panel);
}

}  // namespace springlod::render
