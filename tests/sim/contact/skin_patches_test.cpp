#include "sim/contact/skin_patches.hpp"

#include <algorithm>
#include <random>

#include <catch2/catch.hpp>

using namespace springlod;
using namespace springlod::sim;

namespace {

SurfacePoint point(std::uint32_t group, const Vec3& position, const Vec3& normal, double area = 1) {
  return {group, position, normal.normalized(), area};
}

}  // namespace

TEST_CASE("A flat face of a group is one patch, an edge, a step and another group are not") {
  const Vec3 up = Vec3::UnitZ();
  const std::vector<SurfacePoint> points{point(0, {0, 0, 0}, up, 2), point(0, {1, 0, 0.2}, up),
                                         point(0, {2, 0, 0}, Vec3(1, 0, 0.4)),  // around an edge
                                         point(0, {0, 1, 0.3}, up),             // a step
                                         point(1, {1, 1, 0}, up)};              // another group
  const auto patches = flat_patches(points, 1);
  REQUIRE(patches.size() == 4);
  CHECK(patches[0] == std::vector<std::uint32_t>{0, 1});
  CHECK(patches[1] == std::vector<std::uint32_t>{2});
  CHECK(patches[2] == std::vector<std::uint32_t>{3});
  CHECK(patches[3] == std::vector<std::uint32_t>{4});
}

TEST_CASE("Each point is in one patch, which is flat, of one group and led by its largest point") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> at(-1, 1);
  std::uniform_int_distribution<std::uint32_t> group(0, 20);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 2000; ++i)
    points.push_back(point(group(random), {at(random), at(random), at(random)},
                           {at(random), at(random), at(random)}, 1.1 + at(random)));
  std::vector<int> seen(points.size(), 0);
  std::size_t joined = 0;
  for (const auto& patch : flat_patches(points, 0.5)) {
    joined += patch.size() - 1;
    const SurfacePoint& first = points[patch.front()];
    for (const std::uint32_t p : patch) {
      ++seen[p];
      CHECK(points[p].group == first.group);
      CHECK(points[p].area <= first.area);
      CHECK(points[p].normal.dot(first.normal) >= 0.9);
      CHECK(std::abs(first.normal.dot(points[p].position - first.position)) <= 0.125);
    }
  }
  CHECK(std::count(seen.begin(), seen.end(), 1) == static_cast<std::ptrdiff_t>(points.size()));
  CHECK(joined > 20);
}

TEST_CASE("Edges and corners of a box keep patches of their own") {
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      points.push_back(point(0, Vec3(i, j, 0), Vec3(i == 0 ? -1 : 0, j == 0 ? -1 : 0, 1)));
  const auto patches = flat_patches(points, 1);
  REQUIRE(patches.size() == 4);
  CHECK(patches[0] == std::vector<std::uint32_t>{0});
  CHECK(patches[1] == std::vector<std::uint32_t>{1, 2, 3});
  CHECK(patches[2] == std::vector<std::uint32_t>{4, 8, 12});
  CHECK(patches[3].size() == 9);
}
