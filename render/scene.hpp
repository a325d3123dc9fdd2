#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/choice.hpp"
#include "model/chain.hpp"
#include "model/mesh.hpp"
#include "model/vec.hpp"
#include "render/context.hpp"

namespace springlod::render {

enum class SpringColour { material, strain };

inline constexpr Choice<SpringColour> kSpringColours[] = {
    {SpringColour::material, "material", "of its nodes"},
    {SpringColour::strain, "strain", "red where stretched, blue where compressed"}};
constexpr ChoiceTable<Choice<SpringColour>> choices(SpringColour) {
  return {"spring_colour", kSpringColours};
}

/// Besides their material, balls can tell what eq. 2 of the paper says of their node (Young's
/// modulus, density) or its mass.
enum class NodeColour { material, young, density, mass };

inline constexpr Choice<NodeColour> kNodeColours[] = {
    {NodeColour::material, "material", "its colour"},
    {NodeColour::young, "young", "Young's modulus, as s.estimate has it"},
    {NodeColour::density, "density", "as s.estimate has it"},
    {NodeColour::mass, "mass", "of the node"}};
constexpr ChoiceTable<Choice<NodeColour>> choices(NodeColour) {
  return {"node_colour", kNodeColours};
}

enum class NodeSize { even, mass };

inline constexpr Choice<NodeSize> kNodeSizes[] = {
    {NodeSize::even, "even", "one radius"},
    {NodeSize::mass, "mass", "volumes in proportion to the masses"}};
constexpr ChoiceTable<Choice<NodeSize>> choices(NodeSize) {
  return {"node_size", kNodeSizes};
}

/// automatic: logarithmic if all values are above 0 and span more than two decades.
enum class ValueScaling { automatic, linear, logarithmic };

inline constexpr Choice<ValueScaling> kValueScalings[] = {
    {ValueScaling::automatic, "automatic",
     "logarithmic if all values are above 0 and span more than two decades, else linear"},
    {ValueScaling::linear, "linear", ""},
    {ValueScaling::logarithmic, "logarithmic", ""}};
constexpr ChoiceTable<Choice<ValueScaling>> choices(ValueScaling) {
  return {"value_scale", kValueScalings};
}

struct Camera {
  Vec3 eye{3, -6, 2};
  Vec3 target = Vec3::Zero();
  Vec3 up = Vec3::UnitZ();
  double fov_degrees = 35;  ///< vertical
};

/// How points are looked at.
struct Framing {
  double azimuth = -70;  ///< of the eye, from x towards y [deg]
  double elevation = 15;
  double aspect = 4. / 3;  ///< width / height of the panel
  /// Vertical, of panels up to 4:3; wider ones see no farther to the sides than that, for there a
  /// wide view stretches balls into eggs.
  double fov_degrees = 25;
  double headroom = 0;  ///< part of the height that is kept free above, for labels
  double footroom = 0;  ///< and below, for colour bars
  double margin = 0.1;  ///< kept free above and below, as a part of what the points fill
};
/// A camera that sees all points, which fill the picture. Throws InputError without points.
Camera frame_points(const std::vector<Vec3>& points, const Framing& framing);
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

/// How numbers on nodes become colours.
struct ValueStyle {
  /// Over the colour bar, before the unit of node_colour; of own values with theirs. Empty: a usual
  /// one.
  std::string label = {};
  /// What the ends of the colour scale stand for [SI]; none: least and largest of all panels.
  std::optional<std::pair<double, double>> range = {};
  ValueScaling scaling = ValueScaling::automatic;
};

struct DrawStyle {
  bool surface = true;  ///< shaded surface carried by the nodes
  bool nodes = false;   ///< as shaded balls
  bool springs = false;
  NodeColour node_colour = NodeColour::material;
  ValueStyle values;
  NodeSize node_size = NodeSize::even;  ///< mass: volumes of the balls in proportion to the masses
  SpringColour spring_colour = SpringColour::material;
  double strain_range = 0.1;      ///< strain drawn in full red (stretch) or blue (compression)
  double node_radius = 0;         ///< [m]; 0: a part of the mean spring length
  double surface_opacity = 1;     ///< below 1 shows the springs inside
  bool bold_inner_nodes = false;  ///< nodes off the border in bold red (the paper's figure 4)
  /// Nodes whose rest position has normal . x < offset are left out, with their springs, so that
  /// one sees inside; the surface stays whole.
  std::optional<DrawnPlane> cut;
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
  /// Numbers that the nodes show instead of style.node_colour, one a node; null: none.
  const std::vector<double>* node_values = nullptr;
  /// Colour of each node; empty: as the style says. Renderer fills it where values are shown.
  std::vector<Colour> node_colours;
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

/// How panels of one size make up a picture.
struct PanelGrid {
  std::uint32_t panel_width = 640;  ///< [px]
  std::uint32_t panel_height = 480;
  std::uint32_t panel_count = 1;
  std::uint32_t columns = 0;  ///< panels in a row; 0: all of them
};

/// What is written on the whole picture.
struct PictureText {
  /// In a strip of its own above the panels; lines after the first are smaller.
  std::string title = {};
  std::string footer = {};  ///< across the bottom (the common clock)
};

/// Draws panels side by side, row by row, into one picture: shaded with a shadow on floor and
/// walls, labels on top. Keeps shaders, font and buffers between frames.
class Renderer {
 public:
  explicit Renderer(const PanelGrid& grid);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  /// For pictures of another layout from now on. Where their panels have the size of those before,
  /// context, shaders and font are kept, which saves most of the time a still picture takes.
  void lay_out(const PanelGrid& grid);
  /// Throws InputError for bodies, styles or cameras that cannot be drawn.
  Image draw(std::vector<Panel> panels, const PictureText& text = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace springlod::render
