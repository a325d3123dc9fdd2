#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/choice.hpp"
#include "base/option.hpp"
#include "model/chain.hpp"
#include "model/mesh.hpp"
#include "model/vec.hpp"
#include "render/context.hpp"

namespace springlod::render {

enum class SpringColour { material, strain };

inline constexpr Choice<SpringColour> kSpringColours[] = {
    {SpringColour::material, "material", "material of its nodes"},
    {SpringColour::strain, "strain", "red where stretched, blue where compressed"}};
constexpr ChoiceTable<Choice<SpringColour>> choices(SpringColour) {
  return {"spring_colour", kSpringColours};
}

/// What the colour of a ball shows: the material, Young's modulus or density of the node by eq. 2
/// of the paper (docs/method.md), or its mass.
enum class NodeColour { material, young, density, mass };

inline constexpr Choice<NodeColour> kNodeColours[] = {
    {NodeColour::material, "material", "colour of the node's material"},
    {NodeColour::young, "young", "Young's modulus of the node, as in s.estimate"},
    {NodeColour::density, "density", "density of the node, as in s.estimate"},
    {NodeColour::mass, "mass", "mass of the node"}};
constexpr ChoiceTable<Choice<NodeColour>> choices(NodeColour) {
  return {"node_colour", kNodeColours};
}

enum class NodeSize { even, mass };

inline constexpr Choice<NodeSize> kNodeSizes[] = {
    {NodeSize::even, "even", "equal radii"},
    {NodeSize::mass, "mass", "volumes proportional to the masses"}};
constexpr ChoiceTable<Choice<NodeSize>> choices(NodeSize) {
  return {"node_size", kNodeSizes};
}

/// automatic: logarithmic if all values are positive and span more than two decades, else linear.
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

/// Direction and margins of a camera that frames points.
struct Framing {
  double azimuth = -70;  ///< of the eye, from x towards y [deg]
  double elevation = 15;
  double aspect = 4. / 3;  ///< width / height of the panel
  /// Vertical field of view of panels up to 4:3. Wider panels keep the horizontal field of view of
  /// 4:3, as wide fields of view distort balls at the sides.
  double fov_degrees = 25;
  double headroom = 0;  ///< fraction of the height kept free above, for labels
  double footroom = 0;  ///< fraction kept free below, for colour bars
  double margin = 0.1;  ///< kept free above and below, as a fraction of the framed height
};
/// The camera whose view the points just fill. Throws InputError without points.
Camera frame_points(const std::vector<Vec3>& points, const Framing& framing);
/// A camera that sees the whole box from the direction (azimuth, elevation) [deg].
Camera frame_box(const Box3& box, double azimuth, double elevation, double aspect,
                 double fov_degrees = 35);

/// A floor (plane facing up) or wall (plane facing sideways) as drawn: normal . x = offset.
struct DrawnPlane {
  Vec3 normal = Vec3::UnitZ();
  double offset = 0;
};
/// A box as drawn.
struct DrawnBox {
  Vec3 center = Vec3::Zero();
  Vec3 half_size = Vec3::Ones();
  Mat3 rotation = Mat3::Identity();
};

/// How values on nodes map to colours.
struct ValueStyle {
  /// Label of the colour bar. The unit of node_colour is appended; labels of node_values include
  /// their unit. Empty: a default label.
  std::string label = {};
  /// Values at the ends of the colour scale [SI]; none: smallest and largest of all panels.
  std::optional<std::pair<double, double>> range = {};
  ValueScaling scaling = ValueScaling::automatic;
};
/// Scripts write `range` as a list, which the binding reads.
constexpr auto option_rows(const ValueStyle*) {
  return std::tuple(option("value_label", &ValueStyle::label,
                           "label of the colour bar; with node_values it includes their unit")
                        .within(0, kLongestTitle)
                        .by_default("the name of node_colour"),
                    option("value_scale", &ValueStyle::scaling, "scaling of the colour bar"));
}

struct DrawStyle {
  bool surface = true;  ///< shaded surface that follows the nodes
  bool nodes = false;   ///< as shaded balls
  bool springs = false;
  NodeColour node_colour = NodeColour::material;
  ValueStyle values;
  NodeSize node_size = NodeSize::even;  ///< mass: ball volumes proportional to the masses
  SpringColour spring_colour = SpringColour::material;
  double strain_range = 0.1;      ///< strain drawn in full red (stretch) or blue (compression)
  double node_radius = 0;         ///< [m]; 0: a fraction of the mean spring length
  double surface_opacity = 1;     ///< below 1 shows the springs inside
  bool anchors = true;            ///< marks the anchored nodes
  bool bold_inner_nodes = false;  ///< nodes off the border in bold red (the paper's figure 4)
  /// Hides what has normal . x < offset at rest: nodes, springs and the surface, whose cut face is
  /// hatched if it is closed and opaque and no nodes or springs are drawn.
  std::optional<DrawnPlane> cut;
};
/// True if nodes are drawn.
inline bool draws_balls(const DrawStyle& style) {
  return style.nodes || style.bold_inner_nodes;
}
/// Scripts write `cut` as a list, which the binding reads.
constexpr auto option_rows(const DrawStyle*) {
  return std::tuple(
      option("surface", &DrawStyle::surface, "draw the shaded surface, if there is one"),
      option("nodes", &DrawStyle::nodes, "draw nodes as balls"),
      option("springs", &DrawStyle::springs, "draw springs"),
      option("node_colour", &DrawStyle::node_colour,
             "quantity shown by the colour of a node. All but material add a colour bar, draw the "
             "nodes and hide the surface, unless nodes and surface are given"),
      nested<DrawStyle>(&DrawStyle::values),
      option("node_size", &DrawStyle::node_size, "size of the balls"),
      option("node_radius", &DrawStyle::node_radius,
             "radius of the balls; with node_size = \"mass\" that of a node of mean mass")
          .within(0, 1e6)
          .in(Dimension::length)
          .by_default("a fraction of the mean spring length"),
      option("spring_colour", &DrawStyle::spring_colour,
             "quantity shown by the colour of a spring"),
      option("strain_range", &DrawStyle::strain_range,
             "strain drawn in full red (stretched) or blue (compressed)")
          .within(1e-9, 1e3),
      option("surface_opacity", &DrawStyle::surface_opacity,
             "opacity of the surface; below 1 the springs inside are visible")
          .within(0, 1),
      option("anchors", &DrawStyle::anchors,
             "mark the anchored nodes of a run with dark dots, also those inside the surface"),
      option("bold_inner_nodes", &DrawStyle::bold_inner_nodes,
             "draw nodes that are not border nodes in bold red"));
}

/// One body in one panel at one instant. Its pointers do not own; the caller keeps the data alive.
struct DrawnBody {
  const MassSpringModel* model = nullptr;
  const std::vector<Vec3>* node_positions = nullptr;     ///< of `model`; null: at rest
  const TriangleMesh* surface = nullptr;                 ///< may be null
  const std::vector<Vec3>* surface_positions = nullptr;  ///< null: the mesh's own
  /// Colour of each surface part (by part, e.g. of its material); empty: palette.
  std::vector<Colour> part_colours;
  /// Values that the nodes show instead of style.node_colour, one per node; null: none.
  const std::vector<double>* node_values = nullptr;
  std::vector<std::uint32_t> anchored;  ///< nodes that anchors hold or pull
  /// Colour of each node; empty: by the style. Renderer sets it if values are shown.
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

/// Layout of an image of equal panels.
struct PanelGrid {
  std::uint32_t panel_width = 640;  ///< [px]
  std::uint32_t panel_height = 480;
  std::uint32_t panel_count = 1;
  std::uint32_t columns = 0;  ///< panels in a row; 0: all of them
};

/// Text on the whole image.
struct PictureText {
  /// In a strip above the panels; lines after the first are smaller.
  std::string title = {};
  std::string footer = {};  ///< across the bottom (the common clock)
};

/// Draws panels row by row into one image, shaded, with shadows on floor and walls and labels on
/// top. Caches shaders, font and buffers between images.
class Renderer {
 public:
  explicit Renderer(const PanelGrid& grid);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  /// Changes the layout of the following images. If the panel size stays the same, the context and
  /// shaders are reused, which saves most of the time of a still image.
  void lay_out(const PanelGrid& grid);
  /// Throws InputError for bodies, styles or cameras that cannot be drawn.
  Image draw(std::vector<Panel> panels, const PictureText& text = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace springlod::render
