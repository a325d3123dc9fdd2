#include "voxelize/cells/surface_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <unordered_map>

#include "voxelize/cells/inside.hpp"

namespace springlod::voxelize {
namespace {

// Longest edge of a piece of a triangle, in cells: half the edge of the cubes that gather them, so
// that pieces stick out of theirs by little.
constexpr double kLongestEdge = 0.25;
// Cubes along the edge of a cell.
constexpr double kCubes = 2;
// Distance from the surface at which a place is outside the body, if the surface is, in cells: with
// more than half a cell, the interpolated distance of a surface between two parts is inside.
constexpr double kProbe = 0.6;
// Least distance from the body there, in cells: at the rim of a surface between two parts, the
// interpolated distance is a little above 0.
constexpr double kLeastClearance = 0.25;

// The cube that gathers pieces of the surface, and the direction that they face.
struct Place {
  CellIndex cube{};
  int facing = 0;  // 0 .. 5: -x, +x, -y ..
  bool operator==(const Place& other) const { return cube == other.cube && facing == other.facing; }
};

struct PlaceHash {
  std::size_t operator()(const Place& p) const {
    std::uint64_t hash = static_cast<std::uint64_t>(p.facing);
    constexpr std::uint64_t kPrime = 0x9E3779B97F4A7C15;  // of Fibonacci hashing
    for (const std::int32_t i : p.cube)
      hash = (hash ^ (hash >> 32) ^ static_cast<std::uint32_t>(i)) * kPrime;
    return hash;
  }
};

bool before(const Place& l, const Place& r) {
  return l.cube != r.cube ? grid_order(l.cube, r.cube) : l.facing < r.facing;
}

struct Gathered {
  double area = 0;             // [cells^2]
  Vec3 moment = Vec3::Zero();  // sum of area times position [cells^3]
  Vec3 facing = Vec3::Zero();  // sum of area times normal [cells^2]
};

int facing_of(const Vec3& normal) {
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return 2 * static_cast<int>(axis) + (normal[axis] > 0 ? 1 : 0);
}

// Sums over pieces of the triangles, in their order: deterministic.
class Gatherer {
 public:
  // Corners in units of cells, cell (0, 0, 0) from 0 to 1.
  void add(const std::array<Vec3, 3>& corners) {
    const Vec3 area = (corners[1] - corners[0]).cross(corners[2] - corners[0]) / 2;
    if (!(area.norm() > 0)) return;
    normal_ = area.normalized();
    facing_ = facing_of(normal_);
    split(corners, area.norm());
  }

  std::vector<std::pair<Place, Gathered>> sorted() const {
    std::vector<std::pair<Place, Gathered>> all(found_.begin(), found_.end());
    std::sort(all.begin(), all.end(),
              [](const auto& l, const auto& r) { return before(l.first, r.first); });
    return all;
  }

 private:
  // Halves the longest edge until it is short.
  void split(const std::array<Vec3, 3>& corners, double area) {
    std::size_t longest = 0;
    double length = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double edge = (corners[(i + 1) % 3] - corners[i]).norm();
      if (edge > length) {
        length = edge;
        longest = i;
      }
    }
    if (length <= kLongestEdge) return put((corners[0] + corners[1] + corners[2]) / 3, area);
    const std::size_t next = (longest + 1) % 3;
    const Vec3 middle = (corners[longest] + corners[next]) / 2;
    std::array<Vec3, 3> half = corners;
    half[next] = middle;
    split(half, area / 2);
    half = corners;
    half[longest] = middle;
    split(half, area / 2);
  }

  void put(const Vec3& at, double area) {
    Place place{{}, facing_};
    for (int d = 0; d < 3; ++d)
      place.cube[static_cast<std::size_t>(d)] =
          static_cast<std::int32_t>(std::floor(kCubes * at[d]));
    Gathered& gathered = found_[place];
    gathered.area += area;
    gathered.moment += area * at;
    gathered.facing += area * normal_;
  }

  Vec3 normal_ = Vec3::Zero();
  int facing_ = 0;
  std::unordered_map<Place, Gathered, PlaceHash> found_;
};

// The normal that points out of the body; none for a surface between two parts. Triangles may face
// either way. `at`: in units of cells.
std::optional<Vec3> outward(const MaterialGrid& grid, const Vec3& at, const Vec3& normal) {
  const auto distance = [&](double along) {
    const Vec3 place = at + along * normal - Vec3::Constant(0.5);  // cells have their centres at 0
    return distance_at(*grid.distance, place);
  };
  const double front = distance(kProbe);
  const double back = distance(-kProbe);
  if (std::max(front, back) <= kLeastClearance * grid.cell) return std::nullopt;
  return front >= back ? normal : -normal;
}

}  // namespace

std::vector<SurfacePoint> surface_points(const MaterialGrid& grid, const TriangleMesh& mesh) {
  Gatherer gatherer;
  for (const Triangle& triangle : mesh.triangles) {
    std::array<Vec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = (mesh.positions[triangle[i]] - grid.origin) / grid.cell;
    gatherer.add(corners);
  }
  const IndexLookup lookup(grid.cells);
  std::vector<SurfacePoint> points;
  for (const auto& [place, gathered] : gatherer.sorted()) {
    const Vec3 at = gathered.moment / gathered.area;
    std::optional<SurfacePoint> point = point_in_cells(lookup, at);
    const std::optional<Vec3> normal = outward(grid, at, gathered.facing.normalized());
    if (!point || !normal) continue;
    point->area = gathered.area * grid.cell * grid.cell;
    for (int d = 0; d < 3; ++d)
      point->normal[static_cast<std::size_t>(d)] = static_cast<float>((*normal)[d]);
    points.push_back(*point);
  }
  sort_points(points);
  return points;
}

std::optional<SurfacePoint> point_in_cells(const IndexLookup& filled, const Vec3& at) {
  const Vec3 low = at.array().floor();
  std::optional<SurfacePoint> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 27; ++step) {
    const Vec3 corner = low + Vec3(step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1);
    const CellIndex cell{static_cast<std::int32_t>(corner[0]), static_cast<std::int32_t>(corner[1]),
                         static_cast<std::int32_t>(corner[2])};
    const Vec3 place = at - corner - Vec3::Constant(0.5);
    const double distance = (place.cwiseAbs() - Vec3::Constant(0.5)).cwiseMax(0).norm();
    if (!(distance < least) || filled.find(cell) == kNoIndex) continue;
    least = distance;
    nearest.emplace();
    nearest->cell = cell;
    for (int d = 0; d < 3; ++d)
      nearest->place[static_cast<std::size_t>(d)] = static_cast<float>(place[d]);
  }
  return nearest;
}

void sort_points(std::vector<SurfacePoint>& points) {
  const auto within = [](const SurfacePoint& p) { return std::tie(p.place, p.normal); };
  std::sort(points.begin(), points.end(), [&](const SurfacePoint& l, const SurfacePoint& r) {
    return l.cell != r.cell ? grid_order(l.cell, r.cell) : within(l) < within(r);
  });
}

}  // namespace springlod::voxelize
