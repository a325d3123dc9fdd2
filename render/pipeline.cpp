#include "render/pipeline.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string_view>

#include "base/file.hpp"
#include "render/camera.hpp"
#include "render/cap_painter.hpp"
#include "render/cut.hpp"
#include "render/depth_map.hpp"
#include "render/drawables.hpp"
#include "render/frame_program.hpp"
#include "render/frame_uniforms.hpp"
#include "render/gl.hpp"
#include "render/gpu_slot.hpp"
#include "render/light.hpp"
#include "render/plane_painter.hpp"
#include "render/shaders.hpp"

namespace springlod::render {
namespace {

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
  GlProgram backdrop = frame_program("backdrop", backdrop_shader());
  GlProgram surface = frame_program("surface", surface_shader());
  GlProgram spring = frame_program("spring", spring_shader());
  GlProgram node = frame_program("node", node_shader());
  GlProgram surface_depth = frame_program("surface depth", surface_depth_shader());
  GlProgram spring_depth = frame_program("spring depth", spring_depth_shader());
  GlProgram node_depth = frame_program("node depth", node_depth_shader());
  std::map<std::string, CachedSurface> surfaces;
  std::vector<Slot> slots;
  PlanePainter plane_painter;
  CapPainter cap_painter;
  float occlusion_reach = 1;  // [m]
  std::vector<SpringInstance> edges_of_boxes;

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
      if (!slot.cap.isZero()) slot.cut_parts = parts_by_size(body);
    }
    slot.springs.set(style.springs ? spring_instances(body, origin)
                                   : std::vector<SpringInstance>{});
    slot.nodes.set(draws_balls(style) ? node_instances(body, origin) : std::vector<NodeInstance>{});
    const Box3 box = drawn_bounds(body);
    if (!box.isEmpty()) {
      slot.middle = (box.center() - origin).cast<float>();
      slot.reach = static_cast<float>(box.diagonal().norm());
    }
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
    draw_triangles(slot, 0, slot.surface->split.triangles.size());
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

  void use_surface(const Slot& slot) const {
    glUseProgram(surface.name());
    set(surface, "opacity", slot.opacity);
  }

  void draw_opaque() {
    for (const Slot& slot : slots) {
      if (opaque(slot)) {
        use_surface(slot);
        if (slot.surface->split.closed && !slot.cut) glEnable(GL_CULL_FACE);
        draw_surface(slot);
        glDisable(GL_CULL_FACE);
        if (!slot.cap.isZero()) cap_painter.draw(slot);
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
    PlaneScene planes{.patches = {},
                      .view_radius = static_cast<float>(view_radius(panel.camera)),
                      .light = light,
                      .shaded = !slots.empty()};
    for (const DrawnPlane& p : panel.planes)
      planes.patches.push_back(plane_patch(p, panel.camera, aspect));
    const FrameUniforms frame = frame_uniforms(panel.camera, aspect, light, planes.patches);

    FrameUniforms from_light = frame;
    from_light.view_projection = light.projection;
    from_light.eye << light.direction, 0;
    draw_depths(from_light, shadow_map);
    draw_depths(frame, body_depth);
    shadow_map.bind_compare(static_cast<GLuint>(LightMap::shadow_compare));
    shadow_map.bind_plain(static_cast<GLuint>(LightMap::shadow_depth));
    body_depth.bind_plain(static_cast<GLuint>(LightMap::body_depth));
    context.begin();
    glClear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    draw_backdrop();
    // Bodies first: what they hide of the planes is not shaded.
    draw_opaque();
    plane_painter.draw(planes, false);
    plane_painter.draw_edges(planes, edges_of_boxes, edge_radius(panel.camera));
    draw_transparent();
    plane_painter.draw(planes, true);
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
