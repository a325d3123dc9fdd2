#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/chain.hpp"
#include "model/mesh.hpp"
#include "model/vec.hpp"
#include "render/context.hpp"

namespace springlod {

enum class SpringColour { material, strain };

struct Camera {
  Vec3 eye{3, -6, 2};
  Vec3 target = Vec3::Zero();
  Vec3 up = Vec3::UnitZ();
  double fov_degrees = 35;  ///< vertical
};

/// A camera that sees everything in the box from the direction (azimuth, elevation) [deg].
Camera frame_box(const Box3& box, double azimuth, double elevation, double aspect,
                 double fov_degrees = 35);

/// Floor (a plane facing up), wall (a plane facing sideways) or box, as drawn.
struct DrawnPlane {
  Vec3 normal = Vec3::UnitZ();
  double offset = 0;
};
struct DrawnBox {
  Vec3 center = Vec3::Zero();
  Vec3 half_size = Vec3::Ones();
  Mat3 rotation = Mat3::Identity();
};

struct DrawStyle {
  bool surface = true;  ///< shaded surface carried by the nodes
  bool nodes = false;   ///< as shaded balls
  bool springs = false;
  SpringColour spring_colour = SpringColour::material;
  double strain_range = 0.1;      ///< strain drawn in full red (stretch) or blue (compression)
  double node_radius = 0;         ///< [m]; 0: a part of the mean spring length
  double surface_opacity = 1;     ///< below 1 shows the springs inside
  bool bold_inner_nodes = false;  ///< nodes off the border in bold red (the paper's figure 4)
};

/// Colour in which a material is drawn: its own, or one of the palette if it was left at the
/// default grey (a model in grey alone would tell nothing).
Colour drawn_colour(const MassSpringModel& model, std::uint32_t material);

/// One body in one panel, at one instant. Points into data that the caller keeps alive.
struct DrawnBody {
  const MassSpringModel* model = nullptr;
  const std::vector<Vec3>* node_positions = nullptr;     ///< of `model`; null: at rest
  const TriangleMesh* surface = nullptr;                 ///< may be null
  const std::vector<Vec3>* surface_positions = nullptr;  ///< null: the mesh's own
  /// Colour of each surface part (by part, e.g. of its material); empty: palette.
  std::vector<Colour> part_colours;
  DrawStyle style;
};

struct Panel {
  std::vector<DrawnBody> bodies;
  std::vector<DrawnPlane> planes;
  std::vector<DrawnBox> boxes;
  Camera camera;
  std::string title;                  ///< top left
  std::vector<std::string> captions;  ///< below it, smaller
};

/// Draws panels side by side (left to right, equal widths) into one picture: shaded with a shadow
/// on floor and walls, labels on top. Keeps shaders, font and buffers between frames.
class Renderer {
 public:
  Renderer(std::uint32_t panel_width, std::uint32_t panel_height, std::uint32_t panel_count);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  /// `footer` is written across the bottom (the common clock).
  Image draw(const std::vector<Panel>& panels, const std::string& footer = "");

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace springlod
