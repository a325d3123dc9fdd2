#include "voxelize/mesh/thickness.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace springlod::voxelize {
namespace {

// Points of the surface: the median of fewer is coarse, that of more costs time.
constexpr std::size_t kMostPoints = 128;
constexpr std::size_t kLeastPoints = 16;
// Tests of a ray against a triangle, about a second of them.
constexpr std::size_t kMostTests = 100'000'000;
// Slack of the barycentric coordinates, so that no ray passes between two triangles [1].
constexpr double kSlack = 1e-9;
// The additive recurrence of Roberts (2018), which fills a square evenly: powers of the inverse of
// the plastic number [1].
constexpr double kStep1 = 0.7548776662466927, kStep2 = 0.5698402909980532;

struct Ray {
  Vec3 from, direction;
};

class Surface {
 public:
  /// `sign`: -1 for a solid whose triangles face inwards.
  Surface(const TriangleMesh& mesh, const SolidReport& solid, double sign) : sign_(sign) {
    double area = 0;
    for (const std::uint32_t p : solid.parts)
      for (std::uint32_t i = 0; i < mesh.parts[p].triangle_count; ++i) {
        const Triangle& t = mesh.triangles[mesh.parts[p].first_triangle + i];
        const Vec3& a = mesh.positions[t[0]];
        const Vec3 ab = mesh.positions[t[1]] - a;
        const Vec3 ac = mesh.positions[t[2]] - a;
        area += ab.cross(ac).norm();
        if (!(area > (area_.empty() ? 0 : area_.back()))) continue;  // no area, no normal
        corners_.push_back({a, ab, ac});
        area_.push_back(area);
      }
  }

  std::size_t size() const { return corners_.size(); }

  /// Point `n` of `count`, spread evenly over the area, and the way into the solid from there.
  Ray point(std::size_t n, std::size_t count) const {
    const double at = (static_cast<double>(n) + 0.5) / static_cast<double>(count) * area_.back();
    const auto found = std::upper_bound(area_.begin(), area_.end() - 1, at);
    const Corners& c = corners_[static_cast<std::size_t>(found - area_.begin())];
    double whole = 0;
    double u = std::modf(kStep1 * static_cast<double>(n + 1), &whole);
    double v = std::modf(kStep2 * static_cast<double>(n + 1), &whole);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    return {c.a + u * c.ab + v * c.ac, -sign_ * c.ab.cross(c.ac).normalized()};
  }

  /// The distance at which the ray first leaves the solid [m]; infinite if it never does.
  double way_out(const Ray& ray) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Corners& c : corners_) {
      // Moeller and Trumbore (1997)
      const Vec3 p = ray.direction.cross(c.ac);
      const double determinant = c.ab.dot(p);
      if (!(sign_ * determinant < 0)) continue;  // enters, or passes in the plane of the triangle
      const Vec3 s = ray.from - c.a;
      const double u = s.dot(p) / determinant;
      if (u < -kSlack || u > 1 + kSlack) continue;
      const Vec3 q = s.cross(c.ab);
      const double v = ray.direction.dot(q) / determinant;
      if (v < -kSlack || u + v > 1 + kSlack) continue;
      const double distance = c.ac.dot(q) / determinant;
      if (distance >= 0) nearest = std::min(nearest, distance);
    }
    return nearest;
  }

 private:
  struct Corners {
    Vec3 a, ab, ac;
  };
  double sign_;
  std::vector<Corners> corners_;
  std::vector<double> area_;  // twice the sum of the areas up to each triangle [m2]
};

}  // namespace

double thickness(const TriangleMesh& mesh, const SolidReport& solid, double volume) {
  if (!(std::abs(volume) > 0)) return 0;
  const Surface surface(mesh, solid, solid.volume < 0 ? -1 : 1);
  if (surface.size() == 0) return 0;
  const std::size_t count = std::clamp(kMostTests / surface.size(), kLeastPoints, kMostPoints);
  std::vector<double> distances;
  for (std::size_t n = 0; n < count; ++n) {
    const double distance = surface.way_out(surface.point(n, count));
    if (std::isfinite(distance)) distances.push_back(distance);
  }
  if (distances.empty()) return 0;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

}  // namespace springlod::voxelize
