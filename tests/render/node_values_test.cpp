// Values on nodes: scales, colours, cuts, and panels in rows.

#include "render/node_values.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "elastic/moduli.hpp"
#include "render/camera.hpp"
#include "render/drawables.hpp"
#include "render/value_colour.hpp"
#include "tests/render/bodies.hpp"
#include "tests/render/golden.hpp"

using Catch::Matchers::Contains;
using namespace springlod;
using namespace springlod::render;
using namespace springlod::test;

namespace {

constexpr std::uint32_t kWidth = 240;
constexpr std::uint32_t kHeight = 180;

DrawnBody body_of(const MassSpringModel& model, NodeColour colour) {
  DrawnBody body;
  body.model = &model;
  body.style.surface = false;
  body.style.nodes = body.style.springs = true;
  body.style.node_colour = colour;
  return body;
}

Panel panel_of(const DrawnBody& body) {
  Panel panel;
  panel.bodies = {body};
  panel.camera = frame_points(outline(body), {.headroom = 0.1, .footroom = 0.2});
  return panel;
}

/// CIELAB lightness of an sRGB colour.
double lightness(const Colour& colour) {
  const auto linear = [](float channel) {
    const auto c = static_cast<double>(channel);
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  const double y =
      0.2126 * linear(colour.r) + 0.7152 * linear(colour.g) + 0.0722 * linear(colour.b);
  return 116 * std::cbrt(y) - 16;
}

std::array<int, 3> pixel(const Image& image, std::uint32_t x, std::uint32_t y) {
  const std::uint8_t* p = image.rgb.data() + 3 * (std::size_t{y} * image.width + x);
  return {p[0], p[1], p[2]};
}

}  // namespace

TEST_CASE("Young's modulus on the nodes of a cut ball matches its golden image") {
  const MassSpringModel model = ball();
  DrawnBody body = body_of(model, NodeColour::young);
  body.style.cut = DrawnPlane{Vec3::UnitY(), -0.01};
  Panel panel = panel_of(body);
  panel.title = "base";
  Renderer renderer({kWidth, kHeight, 1});
  check_golden(renderer.draw({panel}, {.title = "Eq. 2\nE of every node"}), "node_values");
}

TEST_CASE("equal steps of the value scale have equal steps of lightness") {
  constexpr int kSteps = 20;
  const double whole = lightness(value_colour(1)) - lightness(value_colour(0));
  CHECK(whole > 60);
  for (int i = 0; i < kSteps; ++i) {
    const double step = lightness(value_colour((i + 1.) / kSteps)) -
                        lightness(value_colour(static_cast<double>(i) / kSteps));
    CHECK(step == Approx(whole / kSteps).epsilon(0.05));
  }
  CHECK(value_colour(-3) == value_colour(0));
  CHECK(value_colour(7) == value_colour(1));
}

TEST_CASE("panels of the same quantity share a scale") {
  MassSpringModel light = ball();
  MassSpringModel heavy = ball();
  heavy.mass.assign(heavy.mass.size(), 3);
  std::vector<Panel> panels{panel_of(body_of(light, NodeColour::mass)),
                            panel_of(body_of(heavy, NodeColour::mass)),
                            panel_of(body_of(heavy, NodeColour::density)),
                            panel_of(body_of(heavy, NodeColour::material))};
  const auto scales = colour_by_values(panels);
  REQUIRE(scales[0]);
  CHECK(scales[0] == scales[1]);
  CHECK(scales[0]->low == 1);
  CHECK(scales[0]->high == 3);
  CHECK(scales[0]->label == "mass (kg)");
  CHECK(panels[0].bodies[0].node_colours[7] == value_colour(0));
  CHECK(panels[1].bodies[0].node_colours[7] == value_colour(1));
  REQUIRE(scales[2]);
  CHECK(scales[2]->label == "density (kg/m\u00b3)");
  CHECK(scales[2]->low == scales[2]->high);
  CHECK(panels[2].bodies[0].node_colours[7] == value_colour(0.5));
  CHECK(!scales[3]);
  CHECK(panels[3].bodies[0].node_colours.empty());
}

TEST_CASE("the scale is logarithmic beyond two decades, unless the style sets another") {
  const MassSpringModel model = ball();
  std::vector<double> values(model.node_count(), 10);
  values[0] = 1;
  values[1] = 1000;
  const auto scale_of = [&](const ValueStyle& style) {
    DrawnBody body = body_of(model, NodeColour::material);
    body.node_values = &values;
    body.style.values = style;
    std::vector<Panel> panels{panel_of(body)};
    return *colour_by_values(panels)[0];
  };
  CHECK(scale_of({}).logarithmic);
  CHECK(scale_of({}).part(10) == Approx(1. / 3));
  CHECK(scale_of({}).value(1. / 3) == Approx(10));
  CHECK(scale_of({}).label == "value");
  CHECK(!scale_of({.scaling = ValueScaling::linear}).logarithmic);
  const ValueScale given = scale_of({.label = "speed (m/s)", .range = {{5, 25}}});
  CHECK(!given.logarithmic);
  CHECK(given.part(10) == Approx(0.25));
  CHECK(given.part(1000) == 1);
  CHECK(given.label == "speed (m/s)");
  values[0] = 0;
  CHECK(!scale_of({}).logarithmic);
  CHECK_THROWS_WITH(scale_of({.scaling = ValueScaling::logarithmic}), Contains("above 0"));
  CHECK_THROWS_WITH(scale_of({.range = {{2, 2}}}), Contains("increasing"));
  values[4] = NAN;
  CHECK_THROWS_WITH(scale_of({}), Contains("node 5"));
  values.pop_back();
  CHECK_THROWS_WITH(scale_of({}), Contains("280 node values"));
}

TEST_CASE("balls can have volumes in proportion to their masses") {
  MassSpringModel model = ball();
  model.mass[3] = 8;
  DrawnBody body = body_of(model, NodeColour::material);
  const auto even = node_instances(body, Vec3::Zero());
  CHECK(even[3].radius == even[4].radius);
  body.style.node_size = NodeSize::mass;
  const auto by_mass = node_instances(body, Vec3::Zero());
  CHECK(by_mass[3].radius == Approx(2 * by_mass[4].radius));
}

TEST_CASE("a cut hides nodes by their rest position, with their springs") {
  const MassSpringModel model = ball();
  const auto x = moved(model.rest, {0, 5, 0});
  DrawnBody body = body_of(model, NodeColour::material);
  body.node_positions = &x;
  body.style.cut = DrawnPlane{Vec3::UnitY(), 0.05};
  const auto nodes = node_instances(body, Vec3::Zero());
  CHECK(nodes.size() < model.node_count());
  CHECK(!nodes.empty());
  for (const NodeInstance& node : nodes) CHECK(node.center.y() >= 5.05F);
  for (const SpringInstance& spring : spring_instances(body, Vec3::Zero()))
    CHECK(std::min(spring.a.y(), spring.b.y()) >= 5.05F);
  body.style.cut->normal = Vec3::Zero();
  CHECK_THROWS_WITH(validate(body), Contains("normal"));
}

TEST_CASE("framed points leave headroom and footroom free") {
  const MassSpringModel model = ball();
  for (const double aspect : {0.6, 4. / 3, 4.}) {
    const Framing framing{.aspect = aspect, .headroom = 0.3, .footroom = 0.1};
    const Camera camera = frame_points(model.rest, framing);
    const Mat4f to_clip = view_projection(camera, aspect);
    float low = 1, high = -1, side = 0;
    for (const Vec3& p : model.rest) {
      const Vec3f r = (p - camera.target).cast<float>();
      const Eigen::Vector4f clip = to_clip * Eigen::Vector4f(r.x(), r.y(), r.z(), 1);
      low = std::min(low, clip.y() / clip.w());
      high = std::max(high, clip.y() / clip.w());
      side = std::max(side, std::abs(clip.x() / clip.w()));
    }
    CAPTURE(aspect);
    CHECK(low > -0.8F);  // of -1..1
    CHECK(high < 0.4F);
    CHECK(side < 1);
    // The points fill the remaining area in one direction.
    CHECK(std::max(side, high - low) > 0.85F);
  }
  CHECK_THROWS_AS(frame_points(model.rest, {.headroom = 0.6, .footroom = 0.4}), InputError);
  CHECK_THROWS_AS(frame_points({}, {}), InputError);
}

TEST_CASE("panels fill rows, and a title stands above them") {
  const MassSpringModel model = ball();
  const Panel panel = panel_of(body_of(model, NodeColour::material));
  Renderer renderer({kWidth, kHeight, 3, 2});
  const Image plain = renderer.draw({panel, panel, panel});
  CHECK(plain.width == 2 * kWidth);
  CHECK(plain.height == 2 * kHeight);
  CHECK(pixel(plain, 2 * kWidth - 5, 2 * kHeight - 5) == std::array{255, 255, 255});
  CHECK(pixel(plain, 5, 2 * kHeight - 5) == pixel(plain, 5, kHeight - 5));
  const Image titled = renderer.draw({panel, panel, panel}, {.title = "one\ntwo"});
  CHECK(titled.width == plain.width);
  REQUIRE(titled.height > plain.height + 20);
  const std::uint32_t strip = titled.height - plain.height;
  std::size_t unequal = 0;
  for (std::uint32_t y = 2; y < plain.height; ++y)  // below the line under the title
    for (std::uint32_t x = 0; x < plain.width; ++x)
      unequal += pixel(plain, x, y) != pixel(titled, x, y + strip) ? 1 : 0;
  CHECK(unequal == 0);
  CHECK_THROWS_AS(Renderer({8192, 10, 3, 3}), InputError);
  CHECK_THROWS_AS(Renderer({10, 8192, 3, 1}), InputError);
}
