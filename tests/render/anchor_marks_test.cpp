#include "render/anchor_marks.hpp"

#include <algorithm>
#include <array>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "render/camera.hpp"
#include "tests/render/bodies.hpp"

using namespace springlod;
using namespace springlod::render;
using namespace springlod::test;

namespace {

/// A bar seen from its side, with an anchored node near one end.
struct Held {
  MassSpringModel model = bar();
  TriangleMesh surface = sphere_mesh(0.2, 16, 8);
  Panel panel;
  std::uint32_t node = 0;

  explicit Held(double aspect) {
    for (Vec3& p : surface.positions) p += model.rest[node];
    panel.camera = frame_points(model.rest, {.azimuth = -90, .elevation = 5, .aspect = aspect});
    DrawnBody body;
    body.model = &model;
    body.surface = &surface;
    body.anchored = {node};
    body.style.springs = true;
    panel.bodies = {body};
  }
  DrawStyle& style() { return panel.bodies[0].style; }
};

/// The darkest and the brightest sum of channels within `reach` pixels of a point of the scene.
std::array<int, 2> range_near(const Image& image, const Camera& camera, const Vec3& point,
                              int reach) {
  Eigen::Vector4f at;
  at << (point - camera.target).cast<float>(), 1;
  const Eigen::Vector4f clip =
      view_projection(camera, static_cast<double>(image.width) / image.height) * at;
  const auto width = static_cast<int>(image.width);
  const auto height = static_cast<int>(image.height);
  const int x = static_cast<int>((clip.x() / clip.w() * 0.5F + 0.5F) * static_cast<float>(width));
  const int y = static_cast<int>((0.5F - clip.y() / clip.w() * 0.5F) * static_cast<float>(height));
  std::array<int, 2> range{3 * 255, 0};
  for (int row = std::max(0, y - reach); row <= std::min(height - 1, y + reach); ++row)
    for (int column = std::max(0, x - reach); column <= std::min(width - 1, x + reach); ++column) {
      const std::uint8_t* p = &image.rgb[3 * static_cast<std::size_t>(row * width + column)];
      const int sum = p[0] + p[1] + p[2];
      range = {std::min(range[0], sum), std::max(range[1], sum)};
    }
  return range;
}

}  // namespace

TEST_CASE("anchored nodes are marked by dark dots with a white rim, also inside the surface") {
  for (const auto& [width, height] : {std::array{320U, 240U}, {1280U, 720U}}) {
    Held held(static_cast<double>(width) / height);
    Renderer renderer({width, height, 1});
    const Vec3& place = held.model.rest[held.node];
    CAPTURE(width);
    const Image marked = renderer.draw({held.panel});
    CHECK(range_near(marked, held.panel.camera, place, 0)[0] < 120);
    CHECK(range_near(marked, held.panel.camera, place, width / 40)[1] > 740);

    held.style().anchors = false;
    const Image plain = renderer.draw({held.panel});
    CHECK(range_near(plain, held.panel.camera, place, width / 40)[0] > 150);
  }
}

TEST_CASE("of anchored nodes, those that are cut away have no mark") {
  Held held(4. / 3);
  Renderer renderer({320, 240, 1});
  const Vec3 place = held.model.rest[held.node];
  held.style().cut = DrawnPlane{Vec3::UnitX(), place.x() - 0.01};
  CHECK(range_near(renderer.draw({held.panel}), held.panel.camera, place, 0)[0] < 120);
  held.style().cut = DrawnPlane{Vec3::UnitX(), place.x() + 0.01};
  CHECK(range_near(renderer.draw({held.panel}), held.panel.camera, place, 0)[0] > 150);
}

TEST_CASE("a picture explains the mark of anchored nodes once") {
  Held held(4. / 3);
  const auto words = [&](bool first, bool second) {
    std::vector<Panel> panels(2, held.panel);
    panels[0].bodies[0].style.anchors = first;
    panels[1].bodies[0].style.anchors = second;
    const Image image = Renderer({320, 240, 2}).draw(panels);
    std::array<int, 2> dark{};  // pixels in the lower left corner of each panel
    for (std::size_t panel = 0; panel < 2; ++panel)
      for (std::size_t y = 215; y < 240; ++y)
        for (std::size_t x = 5; x < 85; ++x) {
          const std::uint8_t* p = &image.rgb[3 * (y * 640 + 320 * panel + x)];
          dark[panel] += p[0] + p[1] + p[2] < 400 ? 1 : 0;
        }
    return dark;
  };
  CHECK(words(false, false) == std::array{0, 0});
  const auto both = words(true, true);
  CHECK(both[0] > 30);
  CHECK(both[1] == 0);
  CHECK(words(false, true)[1] == both[0]);
}

TEST_CASE("anchored nodes that the model does not have are refused") {
  Held held(4. / 3);
  held.panel.bodies[0].anchored = {held.model.node_count()};
  CHECK_THROWS_AS(Renderer({64, 48, 1}).draw({held.panel}), InputError);
}
