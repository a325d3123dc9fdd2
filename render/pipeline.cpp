#include "render/pipeline.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string_view>

#include "base/file.hpp"
#include "render/camera.hpp"
#include "render/cut.hpp"
#include "render/depth_map.hpp"
#include "render/drawables.hpp"
#include "render/frame_uniforms.hpp"
#include "render/gl.hpp"
#include "render/gpu_slot.hpp"
#include "render/light.hpp"
#include "render/plane.hpp"
#include "render/shaders.hpp"

namespace springlod::render {
namespace {

using Vec4f = Eigen::Vector4f;

GlProgram program(const char* name, const ShaderSource& source) {
  GlProgram made = make_program(name, source.vertex, source.fragment);
  glUniformBlockBinding(made.name(), glGetUniformBlockIndex(made.name(), "Frame"), 0);
  glUseProgram(made.name());
  glUniform1i(glGetUniformLocation(made.name(), "shadow_compare"), 0);
  glUniform1i(glGetUniformLocation(made.name(), "shadow_depth"), 1);
  glUniform1i(glGetUniformLocation(made.name(), "body_depth"), 2);
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

constexpr Colour kBoxColour{0.70F, 0.76F, 0.73F};
constexpr Colour kBoxEdgeColour{0.40F, 0.46F, 0.44F};
constexpr Colour kFloorColour{0.935F, 0.938F, 0.942F};
constexpr Colour kRampColour{0.935F, 0.905F, 0.850F};
constexpr Colour kWallColour{0.850F, 0.880F, 0.915F};

Vec3f vector(const Colour& c) {
  return {c.r, c.g, c.b};
}
Vec3f colour_of(PlanePatch::Kind kind) {
  switch (kind) {
    case PlanePatch::Kind::floor:
      return vector(kFloorColour);
    case PlanePatch::Kind::ramp:
      return vector(kRampColour);
    case PlanePatch::Kind::wall:
      break;
  }
  return vector(kWallColour);
}

// Radius of the lines along edges of obstacles [px].
constexpr double kEdgeRadius = 0.8;
constexpr GLsizei kShadowSide = 768;  // [texels]; finer than the soft shadow edge requires

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
  DepthMap shadow_map{kShadowSide, kShadowSide};
  // Half the resolution suffices for ambient occlusion.
  DepthMap body_depth{static_cast<GLsizei>((context.width() + 1) / 2),
                      static_cast<GLsizei>((context.height() + 1) / 2)};
  GlProgram backdrop = program("backdrop", backdrop_shader());
  GlProgram surface = program("surface", surface_shader());
  GlProgram cut_surface = program("cut surface", cut_surface_shader());
  GlProgram spring = program("spring", spring_shader());
  GlProgram line = program("line", line_shader());
  GlProgram node = program("node", node_shader());
  GlProgram plane = program("plane", plane_shader());
  GlProgram plane_shade = program("plane shade", plane_shade_shader());
  GlProgram surface_depth = program("surface depth", surface_depth_shader());
  GlProgram spring_depth = program("spring depth", spring_depth_shader());
  GlProgram node_depth = program("node depth", node_depth_shader());
  std::map<std::string, CachedSurface> surfaces;
  std::vector<Slot> slots;
  Stream<Vec3f> polygon;
  float occlusion_reach = 1;  // [m]
  Stream<SpringInstance> edges;
  std::vector<SpringInstance> edges_of_boxes;

  explicit Impl(OffscreenContext& of) : context(of) {
    polygon.describe({3}, false);
    edges.describe({3, 3, 3, 3, 1}, true);
  }

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
    slot.cut = false;
    slot.cap.setZero();
    if (style.surface && body.surface != nullptr && style.surface_opacity > 0) {
      slot.surface = &cached(*body.surface);
      slot.vertices.set(surface_vertices(body, slot.surface->split, origin));
      slot.cut = style.cut.has_value();
      // Nodes and springs inside are seen past a face that is not drawn.
      if (slot.cut && slot.surface->split.closed && opaque(slot) && !style.springs &&
          !draws_balls(style))
        slot.cap = cut_face(body, origin);
    }
    slot.springs.set(style.springs ? spring_instances(body, origin)
                                   : std::vector<SpringInstance>{});
    slot.nodes.set(draws_balls(style) ? node_instances(body, origin) : std::vector<NodeInstance>{});
    const Box3 box = drawn_bounds(body);
    slot.distance = box.isEmpty() ? 0 : (box.center() - camera.eye).norm();
  }

  float edge_radius(const Camera& camera) const {
    return static_cast<float>(kEdgeRadius * 2 * view_radius(camera) / context.height());
  }

  /// Fills one slot per body, then one per box; returns the bounds of the shadow casters.
  Box3 fill_slots(const Panel& panel) {
    constexpr std::size_t kSurfacesKept = 32;
    if (surfaces.size() > kSurfacesKept) surfaces.clear();
    slots.resize(panel.bodies.size() + panel.boxes.size());
    edges_of_boxes.clear();
    Box3 casters;
    for (std::size_t i = 0; i < panel.bodies.size(); ++i) {
      fill_slot(slots[i], panel.bodies[i], panel.camera);
      casters.extend(drawn_bounds(panel.bodies[i]));
    }
    const double bodies_size = casters.isEmpty() ? 0 : casters.diagonal().norm();
    for (std::size_t i = 0; i < panel.boxes.size(); ++i) {
      const TriangleMesh mesh = box_mesh(panel.boxes[i]);
      fill_slot(slots[panel.bodies.size() + i], box_body(mesh), panel.camera);
      const auto lines =
          box_edges(panel.boxes[i], panel.camera.target, kBoxEdgeColour, edge_radius(panel.camera));
      edges_of_boxes.insert(edges_of_boxes.end(), lines.begin(), lines.end());
      // A box far larger than the bodies would reduce their shadows to a few texels, so only its
      // part near them casts shadows.
      constexpr double kLargeBox = 4;
      const Box3 box = bounds(mesh);
      if (casters.isEmpty() || box.diagonal().norm() <= kLargeBox * bodies_size)
        casters.extend(box);
    }
    constexpr double kOcclusionReach = 0.10;  // of the size of the bodies
    const double size = bodies_size > 0     ? bodies_size
                        : casters.isEmpty() ? 1
                                            : casters.diagonal().norm();
    occlusion_reach = static_cast<float>(kOcclusionReach * size);
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

  /// Depths of all bodies and boxes; of transparent ones only what is inside, if anything is.
  void draw_depths(const FrameUniforms& frame, const DepthMap& map) const {
    set_frame(frame);
    map.begin();
    for (const Slot& slot : slots) {
      const bool only_surface = slot.springs.count == 0 && slot.nodes.count == 0;
      glUseProgram(surface_depth.name());
      if (opaque(slot) || (transparent(slot) && only_surface)) draw_surface(slot);
      if (opaque(slot) && !slot.cut) continue;  // it hides the rest
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

  static void set_patch(const GlProgram& of, const PlanePatch& patch) {
    glUseProgram(of.name());
    set(of, "plane_center", patch.center);
    set(of, "plane_u", patch.u);
    set(of, "plane_v", patch.v);
    set(of, "plane_reach", patch.reach);
    glUniform2fv(uniform(of, "grid_origin"), 1, patch.grid_origin.data());
  }

  void draw_polygon(const std::vector<Vec3f>& points) {
    if (points.empty()) return;
    polygon.set(points);
    glBindVertexArray(polygon.layout.name());
    glDrawArrays(GL_TRIANGLE_FAN, 0, polygon.count);
  }

  void draw_plane(const std::vector<PlanePatch>& patches, std::size_t which, float spacing,
                  const KeyLight& light) {
    const PlanePatch& patch = patches[which];
    constexpr float kGhost = 0.16F;  // opacity of a wall between the viewer and the bodies
    set_patch(plane, patch);
    set(plane, "plane_colour", colour_of(patch.kind));
    set(plane, "plane_alpha", patch.seen_from_behind ? kGhost : 1.0F);
    set(plane, "plane_slope", patch.kind == PlanePatch::Kind::ramp ? 1.0F : 0.0F);
    set(plane, "grid_spacing", spacing);
    const std::vector<Vec3f> points = visible_polygon(patches, which);
    draw_polygon(points);
    if (patch.seen_from_behind || slots.empty()) return;
    // Shadows cost several times what the rest of a plane does, so they multiply its colour in a
    // second pass over the part that can have any.
    set_patch(plane_shade, patch);
    set(plane_shade, "plane_normal", patch.normal);
    glBlendFunc(GL_DST_COLOR, GL_ZERO);
    glDepthMask(GL_FALSE);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(-1, -4);
    draw_polygon(shaded_part(points, light.to_unit_cube));
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDepthMask(GL_TRUE);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  }

  void draw_planes(const std::vector<PlanePatch>& patches, float spacing, const KeyLight& light,
                   bool from_behind) {
    glEnable(GL_BLEND);
    glDepthMask(from_behind ? GL_FALSE : GL_TRUE);
    for (std::size_t i = 0; i < patches.size(); ++i)
      if (patches[i].seen_from_behind == from_behind) draw_plane(patches, i, spacing, light);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
  }

  /// Lines along the edges of boxes, and where planes that the viewer faces meet.
  void draw_edges(const std::vector<PlanePatch>& patches, float radius) {
    std::vector<SpringInstance> lines = edges_of_boxes;
    for (std::size_t i = 0; i < patches.size(); ++i) {
      if (patches[i].seen_from_behind) continue;
      const std::vector<SpringInstance> more = plane_edges(patches, i, radius);
      lines.insert(lines.end(), more.begin(), more.end());
    }
    edges.set(lines);
    glUseProgram(line.name());
    // In front of the surfaces that meet there.
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(-1, -16);
    draw_quads(edges);
    glDisable(GL_POLYGON_OFFSET_FILL);
  }

  void use_surface(const Slot& slot) const {
    const GlProgram& with = slot.cut ? cut_surface : surface;
    glUseProgram(with.name());
    set(with, "opacity", slot.opacity);
    if (slot.cut) glUniform4fv(uniform(with, "cap"), 1, slot.cap.data());
  }

  void draw_opaque() const {
    for (const Slot& slot : slots) {
      if (opaque(slot)) {
        use_surface(slot);
        if (slot.surface->split.closed && !slot.cut) glEnable(GL_CULL_FACE);
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
    for (const Slot* slot : order) {
      use_surface(*slot);
      for (const GLenum hidden : {GL_FRONT, GL_BACK}) {
        glCullFace(hidden);
        draw_surface(*slot);
      }
    }
    glDisable(GL_CULL_FACE);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
  }

  FrameUniforms frame_uniforms(const Camera& camera, double aspect, const KeyLight& light,
                               const std::vector<PlanePatch>& patches) const {
    const CameraAxes axes = camera_axes(camera);
    const auto height = static_cast<float>(context.height());
    const double distance = (camera.eye - camera.target).norm();
    FrameUniforms frame;
    frame.view_projection = view_projection(camera, aspect);
    frame.shadow_projection = light.to_unit_cube;
    frame.from_clip = frame.view_projection.cast<double>().inverse().cast<float>();
    frame.eye << (camera.eye - camera.target).cast<float>(), 1;
    frame.key_light << light.direction, 0;
    frame.world_up << camera.up.normalized().cast<float>(), 0;
    frame.camera_right << axes.right.cast<float>(), 0;
    frame.shadow_size << light.side, light.depth, light.side / kShadowSide, 0;
    frame.pixel << static_cast<float>(2 * view_radius(camera) / distance) / height, occlusion_reach,
        0, 0;
    std::size_t count = 0;
    for (const PlanePatch& patch : patches) {
      if (patch.seen_from_behind || count == kMostPlanes) continue;
      frame.planes[count++] << patch.normal, patch.offset;
    }
    frame.image << static_cast<float>(context.width()), height, static_cast<float>(count), 0;
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
    std::vector<PlanePatch> patches;
    for (const DrawnPlane& p : panel.planes)
      patches.push_back(plane_patch(p, panel.camera, aspect));
    const FrameUniforms frame = frame_uniforms(panel.camera, aspect, light, patches);
    const auto spacing = static_cast<float>(grid_spacing(view_radius(panel.camera)));

    FrameUniforms from_light = frame;
    from_light.view_projection = light.projection;
    from_light.eye << light.direction, 0;
    draw_depths(from_light, shadow_map);
    draw_depths(frame, body_depth);
    shadow_map.bind_compare(0);
    shadow_map.bind_plain(1);
    body_depth.bind_plain(2);
    context.begin();
    glClear(GL_DEPTH_BUFFER_BIT);
    draw_backdrop();
    // Bodies first: what they hide of the planes is not shaded.
    draw_opaque();
    draw_planes(patches, spacing, light, false);
    draw_edges(patches, edge_radius(panel.camera));
    draw_transparent();
    draw_planes(patches, spacing, light, true);
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
