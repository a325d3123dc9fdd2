#include "voxelize/solid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <unordered_map>

#include "model/error.hpp"

namespace springlod {
namespace {

// Part of the bounding diagonal below which two vertices are one: some 10 times the rounding of
// single precision, far below any detail that a grid of cells could show.
constexpr double kWeldTolerance = 1e-6;
// Side of a hash cell in tolerances: so large that few points lie near two cells.
constexpr double kHashCell = 64;

using HashCell = std::array<std::int64_t, 3>;
struct HashCellHash {
  std::size_t operator()(const HashCell& c) const {
    // Teschner et al. 2003, "Optimized spatial hashing for collision detection".
    return static_cast<std::size_t>((c[0] * 73856093) ^ (c[1] * 19349663) ^ (c[2] * 83492791));
  }
};

class Welder {
 public:
  explicit Welder(const TriangleMesh& mesh)
      : mesh_(mesh), low_(bounds(mesh).min()), tolerance_(kWeldTolerance * diagonal(mesh)) {}

  std::uint32_t weld(std::uint32_t v) {
    if (tolerance_ == 0) return 0;  // all vertices at one place
    const Vec3& p = mesh_.positions[v];
    const HashCell from = cell_of(p - Vec3::Constant(tolerance_));
    const HashCell to = cell_of(p + Vec3::Constant(tolerance_));
    std::uint32_t nearest = v;
    for (std::int64_t z = from[2]; z <= to[2]; ++z)
      for (std::int64_t y = from[1]; y <= to[1]; ++y)
        for (std::int64_t x = from[0]; x <= to[0]; ++x) {
          const auto at = cells_.find({x, y, z});
          if (at == cells_.end()) continue;
          for (const std::uint32_t w : at->second)
            if ((mesh_.positions[w] - p).squaredNorm() <= tolerance_ * tolerance_)
              nearest = std::min(nearest, w);
        }
    if (nearest == v) cells_[cell_of(p)].push_back(v);
    return nearest;
  }

 private:
  static double diagonal(const TriangleMesh& mesh) { return bounds(mesh).diagonal().norm(); }
  HashCell cell_of(const Vec3& p) const {
    HashCell cell{};
    for (int d = 0; d < 3; ++d)
      cell[d] = static_cast<std::int64_t>(std::floor((p[d] - low_[d]) / (kHashCell * tolerance_)));
    return cell;
  }

  const TriangleMesh& mesh_;
  Vec3 low_;
  double tolerance_;
  std::unordered_map<HashCell, std::vector<std::uint32_t>, HashCellHash> cells_;
};

struct Edge {
  std::uint32_t solid = 0;
  std::uint32_t low = 0;  // vertices, low < high
  std::uint32_t high = 0;
  int direction = 0;  // +1 if the triangle runs from low to high
};

std::vector<Edge> all_edges(const TriangleMesh& mesh, const std::vector<std::uint32_t>& welded,
                            const std::vector<std::uint32_t>& solid_of_part) {
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::size_t p = 0; p < mesh.parts.size(); ++p)
    for (std::uint32_t i = 0; i < mesh.parts[p].triangle_count; ++i) {
      const Triangle& t = mesh.triangles[mesh.parts[p].first_triangle + i];
      const Triangle w{welded[t[0]], welded[t[1]], welded[t[2]]};
      if (w[0] == w[1] || w[1] == w[2] || w[2] == w[0]) continue;
      for (int e = 0; e < 3; ++e) {
        const std::uint32_t from = w[e];
        const std::uint32_t to = w[(e + 1) % 3];
        edges.push_back(
            {solid_of_part[p], std::min(from, to), std::max(from, to), from < to ? 1 : -1});
      }
    }
  std::sort(edges.begin(), edges.end(), [](const Edge& l, const Edge& r) {
    return std::tie(l.solid, l.low, l.high) < std::tie(r.solid, r.low, r.high);
  });
  return edges;
}

// All triangles of one solid at one edge.
struct EdgeUse {
  Edge edge;
  std::uint32_t count = 0;
  int balance = 0;  // of the directions; 0 where neighbours agree
};

std::vector<EdgeUse> faulty_edges(const std::vector<Edge>& edges) {
  std::vector<EdgeUse> faulty;
  for (std::size_t i = 0; i < edges.size();) {
    EdgeUse use{edges[i]};
    for (; i < edges.size() && edges[i].solid == use.edge.solid && edges[i].low == use.edge.low &&
           edges[i].high == use.edge.high;
         ++i) {
      ++use.count;
      use.balance += edges[i].direction;
    }
    if (use.count % 2 == 1 || use.balance != 0) faulty.push_back(use);
  }
  return faulty;
}

std::vector<std::uint32_t> solids_by_name(const TriangleMesh& mesh) {
  std::map<std::string, std::uint32_t> number;
  std::vector<std::uint32_t> solid_of_part;
  for (const MeshPart& part : mesh.parts)
    solid_of_part.push_back(
        number.try_emplace(part.name, static_cast<std::uint32_t>(number.size())).first->second);
  return solid_of_part;
}

// Joins solids whose boundaries share an edge. Returns whether it joined any.
bool join_open_solids(const std::vector<EdgeUse>& faulty,
                      std::vector<std::uint32_t>& solid_of_part) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> first_at;
  std::vector<std::uint32_t> root(solid_of_part.size());
  std::iota(root.begin(), root.end(), 0U);
  const auto find = [&](std::uint32_t s) {
    while (root[s] != s) s = root[s] = root[root[s]];
    return s;
  };
  bool joined = false;
  for (const EdgeUse& use : faulty) {
    if (use.count != 1) continue;
    const auto [at, is_first] = first_at.try_emplace({use.edge.low, use.edge.high}, use.edge.solid);
    if (is_first || find(at->second) == find(use.edge.solid)) continue;
    const std::uint32_t l = find(at->second);
    const std::uint32_t r = find(use.edge.solid);
    root[std::max(l, r)] = std::min(l, r);
    joined = true;
  }
  for (std::uint32_t& solid : solid_of_part) solid = find(solid);
  return joined;
}

// One reference point for all parts of a solid: each alone may be open.
double volume_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& parts) {
  const Vec3 o = mesh.positions[mesh.triangles[mesh.parts[parts.front()].first_triangle][0]];
  double six_volumes = 0;
  for (const std::uint32_t p : parts)
    for (std::uint32_t i = 0; i < mesh.parts[p].triangle_count; ++i) {
      const Triangle& t = mesh.triangles[mesh.parts[p].first_triangle + i];
      six_volumes += (mesh.positions[t[0]] - o)
                         .dot((mesh.positions[t[1]] - o).cross(mesh.positions[t[2]] - o));
    }
  return six_volumes / 6;
}

}  // namespace

std::vector<std::uint32_t> weld_vertices(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> welded(mesh.positions.size());
  Welder welder(mesh);
  for (std::uint32_t v = 0; v < welded.size(); ++v) welded[v] = welder.weld(v);
  return welded;
}

std::vector<SolidReport> check_solid(const TriangleMesh& mesh) {
  validate(mesh);
  const std::vector<std::uint32_t> welded = weld_vertices(mesh);
  std::vector<std::uint32_t> solid_of_part = solids_by_name(mesh);
  std::vector<EdgeUse> faulty = faulty_edges(all_edges(mesh, welded, solid_of_part));
  if (join_open_solids(faulty, solid_of_part))
    faulty = faulty_edges(all_edges(mesh, welded, solid_of_part));

  std::map<std::uint32_t, std::size_t> place;  // solid -> report
  std::vector<SolidReport> reports;
  for (std::uint32_t p = 0; p < mesh.parts.size(); ++p) {
    if (mesh.parts[p].triangle_count == 0) continue;
    const auto [at, is_new] = place.try_emplace(solid_of_part[p], reports.size());
    if (is_new) reports.emplace_back().part = mesh.parts[p].name;
    reports[at->second].parts.push_back(p);
  }
  for (SolidReport& report : reports) report.volume = volume_of(mesh, report.parts);
  for (const EdgeUse& use : faulty) {
    SolidReport& report = reports[place.at(use.edge.solid)];
    if (use.count != 1) {
      ++report.nonmanifold_edges;
      continue;
    }
    if (report.boundary_edges++ == 0)
      report.first_hole = (mesh.positions[use.edge.low] + mesh.positions[use.edge.high]) / 2;
  }
  return reports;
}

}  // namespace springlod
