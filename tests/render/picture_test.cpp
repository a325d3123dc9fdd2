// What a reader of a picture relies on, measured in its pixels.

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "render/camera.hpp"
#include "render/plane.hpp"
#include "render/scene.hpp"
#include "tests/render/bodies.hpp"

using namespace springlod;
using namespace springlod::render;
using namespace springlod::test;

namespace {

constexpr int kWidth = 240;
constexpr int kHeight = 180;
constexpr double kAspect = 4. / 3;
const Colour kRed{0.90F, 0.30F, 0.10F};

Image draw_one(const Panel& panel) {
  return Renderer({kWidth, kHeight, 1}).draw({panel});
}

std::array<int, 3> pixel(const Image& image, int x, int y) {
  const std::uint8_t* p = image.rgb.data() + 3 * (static_cast<std::size_t>(y) * image.width +
                                                  static_cast<std::size_t>(x));
  return {p[0], p[1], p[2]};
}

/// Where a point is in the picture of a camera [px].
std::array<int, 2> place(const Camera& camera, const Vec3& point) {
  Eigen::Vector4f at;
  at << (point - camera.target).cast<float>(), 1;
  const Eigen::Vector4f clip = view_projection(camera, kAspect) * at;
  return {static_cast<int>((clip.x() / clip.w() * 0.5F + 0.5F) * kWidth),
          static_cast<int>((0.5F - clip.y() / clip.w() * 0.5F) * kHeight)};
}

/// Mean of a channel in a square of 13 pixels around a point.
double mean_near(const Image& image, const Camera& camera, const Vec3& point, std::size_t channel) {
  const auto [x, y] = place(camera, point);
  double sum = 0;
  for (int i = -6; i <= 6; ++i)
    for (int j = -6; j <= 6; ++j) sum += pixel(image, x + i, y + j)[channel];
  return sum / 169;
}

DrawnBody body_of(const TriangleMesh& mesh) {
  DrawnBody body;
  body.surface = &mesh;
  body.part_colours = {kRed};
  return body;
}

TriangleMesh torus_mesh(double ring, double tube) {
  constexpr std::uint32_t kAround = 64;
  constexpr std::uint32_t kAcross = 32;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < kAround; ++i)
    for (std::uint32_t j = 0; j < kAcross; ++j) {
      const double phi = 2 * kPi * i / kAround;
      const double theta = 2 * kPi * j / kAcross;
      const double r = ring + tube * std::cos(theta);
      mesh.positions.emplace_back(r * std::cos(phi), r * std::sin(phi), tube * std::sin(theta));
      const std::uint32_t next = (i + 1) % kAround * kAcross;
      const std::uint32_t up = (j + 1) % kAcross;
      mesh.triangles.push_back({i * kAcross + j, next + j, next + up});
      mesh.triangles.push_back({i * kAcross + j, next + up, i * kAcross + up});
    }
  mesh.parts = {{"torus", "", 0, static_cast<std::uint32_t>(mesh.triangles.size())}};
  return mesh;
}

/// A cube of side 1 around the origin, turned about z [rad].
TriangleMesh turned_cube(double angle) {
  TriangleMesh mesh;
  const Eigen::AngleAxisd turn(angle, Vec3::UnitZ());
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back(turn * Vec3((i & 1) - 0.5, (i >> 1 & 1) - 0.5, (i >> 2) - 0.5));
  for (const auto& [a, b, c, d] : {std::array<std::uint32_t, 4>{0, 2, 3, 1},
                                   {4, 5, 7, 6},
                                   {0, 1, 5, 4},
                                   {2, 6, 7, 3},
                                   {0, 4, 6, 2},
                                   {1, 3, 7, 5}}) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  mesh.parts = {{"cube", "", 0, 12}};
  return mesh;
}

/// Fraction of the pixels of a row that differ from their right neighbours.
double changes(const Image& image, int y) {
  int count = 0;
  for (int x = 0; x + 1 < kWidth; ++x)
    count += pixel(image, x, y) != pixel(image, x + 1, y) ? 1 : 0;
  return static_cast<double>(count) / (kWidth - 1);
}

}  // namespace

TEST_CASE("the cut face of a torus leaves its hole open") {
  const TriangleMesh mesh = torus_mesh(1, 0.4);
  Panel panel;
  panel.camera = frame_box(bounds(mesh.positions), -90, 35, kAspect);
  panel.bodies = {body_of(mesh)};
  panel.bodies[0].style.cut = DrawnPlane{Vec3::UnitY(), 0};
  const Image image = draw_one(panel);
  constexpr std::size_t kBlue = 2;  // hatching mixes it with white
  CHECK(mean_near(image, panel.camera, Vec3(1, 0, 0), kBlue) > 70);
  CHECK(mean_near(image, panel.camera, Vec3(-1, 0, 0), kBlue) > 70);
  CHECK(mean_near(image, panel.camera, Vec3(0, 0.6, 0), kBlue) < 60);  // the wall of the hole
}

TEST_CASE("of nested parts, the cut face shows each in its colour") {
  TriangleMesh mesh = sphere_mesh(0.4, 32, 16);
  const TriangleMesh shell = sphere_mesh(1, 48, 24);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const auto inner = static_cast<std::uint32_t>(mesh.triangles.size());
  mesh.positions.insert(mesh.positions.end(), shell.positions.begin(), shell.positions.end());
  for (const Triangle& t : shell.triangles)
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  mesh.parts = {{"core", "", 0, inner},
                {"shell", "", inner, static_cast<std::uint32_t>(shell.triangles.size())}};
  Panel panel;
  panel.camera = frame_box(bounds(mesh.positions), -90, 10, kAspect);
  panel.bodies = {body_of(mesh)};
  panel.bodies[0].part_colours = {kRed, {0.2F, 0.3F, 0.9F}};
  panel.bodies[0].style.cut = DrawnPlane{Vec3::UnitY(), 0};
  const Image image = draw_one(panel);
  const auto redder = [&](const Vec3& p) {
    return mean_near(image, panel.camera, p, 0) - mean_near(image, panel.camera, p, 2);
  };
  CHECK(redder(Vec3::Zero()) > 60);
  CHECK(redder(Vec3(0.7, 0, 0)) < -60);
  CHECK(redder(Vec3(-0.7, 0, 0)) < -60);
}

TEST_CASE("a cut leaves no specks beside the body") {
  const TriangleMesh mesh = sphere_mesh(1, 48, 24);
  Panel panel;
  for (const double elevation : {5., 15., 25., 40.}) {
    panel.camera = frame_box(bounds(mesh.positions), -70, elevation, kAspect);
    panel.bodies.clear();
    const Image empty = draw_one(panel);
    panel.bodies = {body_of(mesh)};
    panel.bodies[0].style.cut = DrawnPlane{Vec3::UnitY(), 0};
    const Image cut = draw_one(panel);
    const auto drawn = [&](int x, int y) { return pixel(cut, x, y) != pixel(empty, x, y); };
    int pixels = 0;
    int specks = 0;
    for (int y = 1; y + 1 < kHeight; ++y)
      for (int x = 1; x + 1 < kWidth; ++x) {
        if (!drawn(x, y)) continue;
        ++pixels;
        int neighbours = -1;
        for (int i = -1; i <= 1; ++i)
          for (int j = -1; j <= 1; ++j) neighbours += drawn(x + i, y + j) ? 1 : 0;
        specks += neighbours <= 1 ? 1 : 0;
      }
    CAPTURE(elevation);
    CHECK(pixels > 3000);
    CHECK(specks == 0);
  }
}

TEST_CASE("arrows mark a ramp at any scale of the view") {
  for (const double size : {0.011, 0.27, 1., 9.5, 31.}) {
    Panel panel;
    panel.camera = frame_box(Box3(Vec3::Constant(-size), Vec3::Constant(size)), -110, 35, kAspect);
    const auto strongly_coloured = [&](const Vec3& normal) {
      panel.planes = {{normal, -0.5 * size}};
      const Image image = draw_one(panel);
      int count = 0;
      for (int y = kHeight / 3; y < kHeight * 4 / 5; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const auto [r, g, b] = pixel(image, x, y);
          count += r - b > 35 ? 1 : 0;
        }
      return count / (kWidth * kHeight * 7. / 15);
    };
    CAPTURE(size);
    CHECK(strongly_coloured(Vec3(-0.4, 0, 1)) > 0.03);
    CHECK(strongly_coloured(Vec3(-0.4, 0, 1)) < 0.20);
    CHECK(strongly_coloured(Vec3::UnitZ()) == 0);
    const double spacing = arrow_spacing(view_radius(panel.camera));
    CHECK(spacing >= 0.33 * view_radius(panel.camera));
    CHECK(spacing <= 1.01 * view_radius(panel.camera));
  }
}

TEST_CASE("smooth shading is dithered, so that it has no bands") {
  Panel panel;
  const TriangleMesh ball = sphere_mesh(1, 256, 128);
  panel.camera = frame_box(Box3(Vec3::Constant(-1), Vec3::Constant(1)), -90, 0, kAspect);
  const Image backdrop = draw_one(panel);
  // Without dither, no pixel of a row of the backdrop differs from its neighbour.
  int dithered = 0;
  for (int y = 0; y < kHeight / 2; ++y) dithered += changes(backdrop, y) > 0.2 ? 1 : 0;
  CHECK(dithered > kHeight / 4);
  // A part of the ball in which the shading changes by a few steps in all.
  panel.bodies = {body_of(ball)};
  panel.camera = frame_box(Box3(Vec3(-0.1, -1, -0.1), Vec3(0.1, -0.9, 0.1)), -90, 0, kAspect);
  const Image near = draw_one(panel);
  int smooth = 0;
  for (int y = 0; y < kHeight; ++y) smooth += changes(near, y) > 0.5 ? 1 : 0;
  CHECK(smooth > kHeight * 9 / 10);
}

TEST_CASE("a floor and what stands on it are darker where they meet, on the lit side too") {
  Panel panel;
  panel.planes = {{Vec3::UnitZ(), 0}};
  panel.camera = frame_box(Box3(Vec3(-1, -1, 0), Vec3(1, 1, 1)), -90, 30, kAspect);
  const Image bare = draw_one(panel);
  panel.boxes = {{Vec3(0.4, 0.4, 0.3), Vec3(0.3, 0.3, 0.3)}};
  const Image standing = draw_one(panel);
  panel.planes.clear();
  const Image afloat = draw_one(panel);
  const auto ratio = [&](const Image& with, const Image& without, const Vec3& point) {
    const auto [x, y] = place(panel.camera, point);
    return static_cast<double>(pixel(with, x, y)[1]) / pixel(without, x, y)[1];
  };
  const auto of_floor = [&](double away) {
    return ratio(standing, bare, Vec3(0.4, 0.1 - away, 0));
  };
  CAPTURE(of_floor(0.03), of_floor(0.7));
  CHECK(of_floor(0.03) < 0.97);
  CHECK(of_floor(0.7) > 0.99);
  const auto of_box = [&](double height) {
    return ratio(standing, afloat, Vec3(0.4, 0.1, height));
  };
  CAPTURE(of_box(0.04), of_box(0.5));
  CHECK(of_box(0.04) < 0.95);
  CHECK(of_box(0.5) > 0.99);
}

TEST_CASE("the corner where a box stands on another is darker than the open face") {
  Panel panel;
  panel.camera = frame_box(Box3(Vec3(-1, -1, 0), Vec3(1, 1, 1)), -90, 35, kAspect);
  const DrawnBox slab{Vec3(0, 0, -0.1), Vec3(1, 1, 0.1)};
  panel.boxes = {slab};
  const Image open = draw_one(panel);
  panel.boxes = {slab, {Vec3(0.4, 0.4, 0.3), Vec3(0.3, 0.3, 0.3)}};
  const Image corner = draw_one(panel);
  const auto ratio = [&](double from_pillar) {
    const auto [x, y] = place(panel.camera, Vec3(0.4, 0.1 - from_pillar, 0));  // its lit side
    return static_cast<double>(pixel(corner, x, y)[1]) / pixel(open, x, y)[1];
  };
  CAPTURE(ratio(0.03), ratio(0.7));
  CHECK(ratio(0.03) < 0.97);
  CHECK(ratio(0.7) > 0.98);
}

TEST_CASE("a face that light grazes has no stripes of its own shadow") {
  // The depth of such a face changes much from texel to texel of the shadow map.
  for (int degrees = 0; degrees < 90; degrees += 15) {
    const TriangleMesh mesh = turned_cube(degrees * kPi / 180);
    Panel panel;
    panel.camera = frame_box(bounds(mesh.positions), -90, 15, kAspect);
    panel.bodies = {body_of(mesh)};
    const Image image = draw_one(panel);
    for (int side = 0; side < 4; ++side) {
      const double angle = degrees * kPi / 180 + side * kPi / 2;
      const Vec3 outward(std::cos(angle), std::sin(angle), 0);
      if (outward.y() > -0.4) continue;  // away from the camera, or seen at a narrow angle
      const auto [x, y] = place(panel.camera, outward / 2);
      int low = 255;
      int high = 0;
      for (int i = -8; i <= 8; ++i)
        for (int j = -8; j <= 8; ++j) {
          const int red = pixel(image, x + i, y + j)[0];
          low = std::min(low, red);
          high = std::max(high, red);
        }
      CAPTURE(degrees, side, low, high);
      CHECK(high - low <= 2);  // the dither
    }
  }
}
