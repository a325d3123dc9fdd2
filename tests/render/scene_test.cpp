#include "render/scene.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "tests/render/bodies.hpp"
#include "tests/render/golden.hpp"

using namespace springlod;
using namespace springlod::render;
using namespace springlod::test;

namespace {

constexpr std::uint32_t kWidth = 240;
constexpr std::uint32_t kHeight = 180;
constexpr double kAspect = 4. / 3;

Panel studio(const Box3& box) {
  Panel panel;
  panel.camera = frame_box(box, -110, 15, kAspect);
  panel.planes = {{Vec3::UnitZ(), 0}};
  return panel;
}

Image draw_one(const Panel& panel, const std::string& footer = "") {
  Renderer renderer({kWidth, kHeight, 1});
  return renderer.draw({panel}, {.footer = footer});
}

std::array<int, 3> pixel(const Image& image, std::uint32_t x, std::uint32_t y) {
  const std::uint8_t* p = image.rgb.data() + 3 * (std::size_t{y} * image.width + x);
  return {p[0], p[1], p[2]};
}

struct BallScene {
  MassSpringModel model = ball();
  std::vector<Vec3> x = moved(model.rest, {0, 0, 0.45});
  Box3 box = bounds(x);
  DrawnBody body() const {
    DrawnBody b;
    b.model = &model;
    b.node_positions = &x;
    b.style.surface = false;
    b.style.nodes = b.style.springs = true;
    return b;
  }
};

struct DumbbellScene {
  TriangleMesh mesh = dumbbell_mesh(32);
  std::vector<Vec3> x = bent(mesh.positions, 1.4, {0.3, 0, 0.32});
  Box3 box = bounds(x);
  DrawnBody body() const {
    DrawnBody b;
    b.surface = &mesh;
    b.surface_positions = &x;
    b.part_colours = {{0.25F, 0.45F, 0.68F}, {0.90F, 0.55F, 0.15F}, {0.25F, 0.45F, 0.68F}};
    return b;
  }
};

}  // namespace

TEST_CASE("a bent dumbbell on a floor before a wall matches its golden image") {
  const DumbbellScene scene;
  Box3 box = scene.box;
  box.extend(Vec3(1, 0, 0));
  Panel panel = studio(box);
  panel.planes.push_back({-Vec3::UnitX(), -1.0});
  panel.bodies = {scene.body()};
  panel.title = "base";
  check_golden(draw_one(panel, "t = 0.433 s"), "dumbbell");
}

TEST_CASE("nodes and springs in the colours of their materials match their golden image") {
  const BallScene scene;
  Panel panel = studio(scene.box);
  panel.bodies = {scene.body()};
  check_golden(draw_one(panel), "ball");
}

TEST_CASE("springs inside a transparent surface match their golden image") {
  const BallScene scene;
  const TriangleMesh skin = sphere_mesh(0.5, 48, 24);
  const auto skin_x = moved(skin.positions, {0, 0, 0.5});
  Panel panel = studio(bounds(skin_x));
  DrawnBody body = scene.body();
  body.surface = &skin;
  body.surface_positions = &skin_x;
  body.style.surface = true;
  body.style.surface_opacity = 0.3;
  panel.bodies = {body};
  check_golden(draw_one(panel), "glass");
}

TEST_CASE("strain colours with their scale, a box and bold inner nodes match their golden image") {
  const MassSpringModel model = bar();
  const auto x = bent(model.rest, 1.4, {0, 0, 0.3});
  Panel panel = studio(bounds(x));
  DrawnBody body;
  body.model = &model;
  body.node_positions = &x;
  body.style.surface = false;
  body.style.springs = true;
  body.style.bold_inner_nodes = true;
  body.style.spring_colour = SpringColour::strain;
  panel.bodies = {body};
  panel.boxes = {{Vec3(0.3, 0.35, 0.1), Vec3(0.1, 0.1, 0.1)}};
  check_golden(draw_one(panel), "strain");
}

TEST_CASE("the floor is darker in a body's shadow than beside it") {
  const DumbbellScene scene;
  Panel panel = studio(scene.box);
  panel.bodies = {scene.body()};
  panel.camera = frame_box(scene.box, -110, 60, kAspect);  // from above: nothing hides the shadow
  const Image with = draw_one(panel);
  panel.bodies.clear();
  const Image without = draw_one(panel);
  // The body hides a part of the floor; where it does not, grey differences are shadow.
  int darker = 0;
  for (std::size_t p = 0; p < with.rgb.size(); p += 3) {
    const int r = with.rgb[p];
    const int b = with.rgb[p + 2];
    const bool grey = std::abs(r - b) < 20 && r > 70;
    if (grey && without.rgb[p] - r > 40) ++darker;
  }
  CHECK(darker > 300);
  // The light comes from the left: the floor there is unchanged.
  CHECK(pixel(with, 5, kHeight - 5) == pixel(without, 5, kHeight - 5));
}

TEST_CASE("a cut body shows a hatched face in the colours of its parts instead of its surface") {
  const TriangleMesh mesh = dumbbell_mesh(32);
  DrawnBody body;
  body.surface = &mesh;
  body.part_colours = {{0.25F, 0.45F, 0.68F}, {0.90F, 0.55F, 0.15F}, {0.25F, 0.45F, 0.68F}};
  Panel panel;
  panel.camera = frame_box(bounds(mesh.positions), -90, 10, kAspect);
  panel.bodies = {body};
  const Image whole = draw_one(panel);
  panel.bodies[0].style.cut = DrawnPlane{Vec3::UnitY(), 0};
  const Image cut = draw_one(panel);
  CHECK(difference(whole, cut).share_beyond > 0.03);
  const auto [r, g, b] = pixel(cut, kWidth / 2, kHeight / 2);
  CHECK(r > b + 40);                                          // the joint
  panel.bodies[0].style.cut = DrawnPlane{Vec3::UnitY(), -9};  // cuts nothing away
  CHECK(difference(draw_one(panel), whole).share_beyond < 0.005);
  panel.bodies[0].style.cut = DrawnPlane{Vec3::UnitY(), 9};  // cuts all away
  const Image none = draw_one(panel);
  panel.bodies.clear();
  CHECK(difference(draw_one(panel), none).share_beyond == 0);
}

TEST_CASE("a ramp has another colour than a floor") {
  const BallScene scene;
  Panel panel = studio(scene.box);
  const auto [floor_r, floor_g, floor_b] = pixel(draw_one(panel), 30, kHeight - 30);
  panel.planes = {{Vec3(-0.2, 0, 1), 0}};
  const auto [ramp_r, ramp_g, ramp_b] = pixel(draw_one(panel), 30, kHeight - 30);
  CHECK(floor_b >= floor_r);
  CHECK(ramp_r > ramp_b + 10);
}

TEST_CASE("equal panels give equal images side by side") {
  const BallScene scene;
  Panel panel = studio(scene.box);
  panel.bodies = {scene.body()};
  panel.title = "level";
  Renderer renderer({kWidth, kHeight, 3});
  const Image image = renderer.draw({panel, panel, panel});
  REQUIRE(image.width == 3 * kWidth);
  std::size_t unequal = 0;
  const std::uint32_t above_scales = kHeight * 9 / 10;  // the grid scale is written only once
  for (std::uint32_t y = 0; y < above_scales; ++y)
    for (std::uint32_t x = 1; x + 1 < kWidth; ++x)  // the divider covers the outermost columns
      for (std::uint32_t k = 1; k < 3; ++k)
        unequal += pixel(image, x, y) != pixel(image, x + k * kWidth, y) ? 1 : 0;
  CHECK(unequal == 0);
}

TEST_CASE(
    "the same scene gives the same bytes, also after other scenes and from another renderer") {
  const BallScene ball_scene;
  const DumbbellScene dumbbell_scene;
  Panel a = studio(ball_scene.box);
  a.bodies = {ball_scene.body()};
  Panel b = studio(dumbbell_scene.box);
  b.bodies = {dumbbell_scene.body(), ball_scene.body()};
  Renderer renderer({kWidth, kHeight, 1});
  const Image first = renderer.draw({a});
  const Image other = renderer.draw({b});
  CHECK(renderer.draw({a}).rgb == first.rgb);
  CHECK(other.rgb != first.rgb);
  Renderer second({kWidth, kHeight, 1});
  CHECK(second.draw({a}).rgb == first.rgb);
  CHECK(renderer.draw({b}).rgb == other.rgb);
}

TEST_CASE("a renderer with a changed layout draws the same as a new one") {
  const BallScene ball_scene;
  const DumbbellScene dumbbell_scene;
  Panel a = studio(ball_scene.box);
  a.bodies = {ball_scene.body()};
  Panel b = studio(dumbbell_scene.box);
  b.bodies = {dumbbell_scene.body()};
  const auto fresh = [](const PanelGrid& grid, const std::vector<Panel>& panels) {
    return Renderer(grid).draw(panels);
  };
  const PanelGrid wide{kWidth, kHeight, 2};
  const PanelGrid high{kWidth, kHeight, 2, 1};
  const PanelGrid small{kWidth / 2, kHeight / 2, 1};
  Renderer kept(wide);
  CHECK(kept.draw({a, b}).rgb == fresh(wide, {a, b}).rgb);
  kept.lay_out(high);
  const Image column = kept.draw({b, a});
  CHECK(column.height == 2 * kHeight);
  CHECK(column.rgb == fresh(high, {b, a}).rgb);
  kept.lay_out(small);  // needs another context
  CHECK(kept.draw({b}).rgb == fresh(small, {b}).rgb);
  kept.lay_out(wide);
  CHECK(kept.draw({a, b}).rgb == fresh(wide, {a, b}).rgb);
  CHECK_THROWS_AS(kept.lay_out({kWidth, kHeight, 0}), InputError);
  CHECK(kept.draw({a, b}).rgb == fresh(wide, {a, b}).rgb);  // a refused layout changes nothing
}

TEST_CASE("title, captions and footer are drawn") {
  const DumbbellScene scene;
  Panel panel = studio(scene.box);
  const Image bare = draw_one(panel);
  panel.title = "base: 368 nodes";
  panel.captions = {"18.6\u00d7 fewer"};
  const Image labelled = draw_one(panel, "t = 0.433 s");
  const auto dark_pixels = [&](const Image& image, std::uint32_t x0, std::uint32_t y0,
                               std::uint32_t x1, std::uint32_t y1) {
    int dark = 0;
    for (std::uint32_t y = y0; y < y1; ++y)
      for (std::uint32_t x = x0; x < x1; ++x) dark += pixel(image, x, y)[0] < 110 ? 1 : 0;
    return dark;
  };
  CHECK(dark_pixels(bare, 0, 0, 160, 45) == 0);
  CHECK(dark_pixels(labelled, 0, 0, 160, 45) > 100);
  CHECK(dark_pixels(bare, 70, 150, 170, 180) == 0);
  CHECK(dark_pixels(labelled, 70, 150, 170, 180) > 50);
}

TEST_CASE("panels of one strain range share one colour scale, on the last of them") {
  const BallScene scene;
  Panel panel = studio(scene.box);
  panel.bodies = {scene.body()};
  panel.bodies[0].style.spring_colour = SpringColour::strain;
  Renderer renderer({kWidth, kHeight, 2});
  const Image image = renderer.draw({panel, panel});
  int strong = 0;  // pixels of the red end of the scale, at the bottom right
  for (const std::uint32_t left : {0U, kWidth})
    for (std::uint32_t y = kHeight * 3 / 4; y < kHeight; ++y)
      for (std::uint32_t x = left + kWidth / 2; x < left + kWidth; ++x) {
        const auto [r, g, b] = pixel(image, x, y);
        if (r - b > 100) strong += left == 0 ? -100000 : 1;
      }
  CHECK(strong > 10);
}

TEST_CASE("a label that is too long is shortened and stays inside its panel") {
  const DumbbellScene scene;
  Panel plain = studio(scene.box);
  Panel wordy = plain;
  wordy.title = std::string(200, 'W');
  Renderer renderer({kWidth, kHeight, 2});
  const Image with = renderer.draw({wordy, plain});
  const Image without = renderer.draw({plain, plain});
  std::size_t changed = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = kWidth; x < 2 * kWidth; ++x)
      changed += pixel(with, x, y) != pixel(without, x, y) ? 1 : 0;
  CHECK(changed == 0);
  CHECK(with.rgb != without.rgb);
}

TEST_CASE("a framed box lies inside the picture from every side") {
  const Box3 box(Vec3(-3, 1, 0), Vec3(2, 2, 0.5));
  for (const double azimuth : {-170., -70., 0., 45., 130.})
    for (const double elevation : {-20., 15., 60., 90.}) {
      const Camera camera = frame_box(box, azimuth, elevation, kAspect);
      for (int i = 0; i < 8; ++i) {
        const Vec3 r = box.corner(static_cast<Box3::CornerType>(i)) - camera.eye;
        const Vec3 forward = (camera.target - camera.eye).normalized();
        const double depth = r.dot(forward);
        const double away = (r - depth * forward).norm();
        CHECK(depth > 0);
        // Within the picture's diagonal, half a field of view from the middle.
        CHECK(away / depth < std::tan(camera.fov_degrees * kPi / 360) * std::hypot(1, kAspect));
      }
    }
}

TEST_CASE("invalid input is refused with a reason") {
  CHECK_THROWS_AS(Renderer({0, 480, 1}), InputError);
  CHECK_THROWS_AS(Renderer({640, 0, 1}), InputError);
  CHECK_THROWS_AS(Renderer({640, 480, 0}), InputError);
  CHECK_THROWS_AS(Renderer({16385, 10, 1}), InputError);
  CHECK_THROWS_AS(Renderer({640, 16385, 1}), InputError);
  CHECK_THROWS_AS(Renderer({4294967295U, 480, 2}), InputError);
  CHECK_THROWS_AS(frame_box(Box3(), 0, 0, 1), InputError);

  const BallScene scene;
  Renderer renderer({64, 48, 1});
  Panel panel = studio(scene.box);
  CHECK_THROWS_AS(renderer.draw({panel, panel}), InputError);
  panel.bodies = {scene.body()};
  std::vector<Vec3> wrong = scene.x;
  wrong[7].x() = NAN;
  panel.bodies[0].node_positions = &wrong;
  CHECK_THROWS_WITH(renderer.draw({panel}), Catch::Contains("node 8"));
  wrong.pop_back();
  CHECK_THROWS_WITH(renderer.draw({panel}), Catch::Contains("280 positions"));
  panel.bodies = {scene.body()};
  panel.bodies[0].style.surface_opacity = 2;
  CHECK_THROWS_WITH(renderer.draw({panel}), Catch::Contains("surface_opacity"));
  panel.bodies.clear();
  panel.planes = {{Vec3::Zero(), 0}};
  CHECK_THROWS_WITH(renderer.draw({panel}), Catch::Contains("normal"));
  panel.planes.clear();
  panel.camera.eye = panel.camera.target;
  CHECK_THROWS_WITH(renderer.draw({panel}), Catch::Contains("camera"));
}
