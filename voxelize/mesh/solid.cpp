#include "voxelize/mesh/solid.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <tuple>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "base/disjoint_sets.hpp"
#include "voxelize/mesh/weld.hpp"

namespace springlod::voxelize {
namespace {

// An edge of a triangle of a solid.
struct EdgeUse {
  std::uint32_t high = 0;  // the higher vertex; the edge is listed under the lower one
  std::uint32_t solid = 0;
  int direction = 0;  // +1 if the triangle runs towards `high`
};

/// The edges of all triangles, listed under their lower vertex; the time is linear in the
/// triangles.
class EdgeLists {
 public:
  EdgeLists(const TriangleMesh& mesh, const std::vector<std::uint32_t>& welded,
            const std::vector<std::uint32_t>& solid_of_part)
      : first_(mesh.positions.size() + 1, 0) {
    for_each_edge(mesh, welded, [&](std::uint32_t from, std::uint32_t to, std::size_t) {
      ++first_[std::min(from, to)];
    });
    std::size_t uses = 0;
    for (std::size_t& first : first_)
      first = uses += first;  // the end of its list until it is filled
    uses_.resize(uses);
    for_each_edge(mesh, welded, [&](std::uint32_t from, std::uint32_t to, std::size_t part) {
      uses_[--first_[std::min(from, to)]] = {std::max(from, to), solid_of_part[part],
                                             from < to ? 1 : -1};
    });
  }

  /// The edges under vertex `low`; the caller may sort them.
  std::span<EdgeUse> under(std::uint32_t low) {
    return std::span(uses_).subspan(first_[low], first_[low + 1] - first_[low]);
  }

 private:
  template <typename Visit>
  static void for_each_edge(const TriangleMesh& mesh, const std::vector<std::uint32_t>& welded,
                            Visit visit) {
    for (std::size_t p = 0; p < mesh.parts.size(); ++p)
      for (std::uint32_t i = 0; i < mesh.parts[p].triangle_count; ++i) {
        const Triangle& t = mesh.triangles[mesh.parts[p].first_triangle + i];
        const Triangle w{welded[t[0]], welded[t[1]], welded[t[2]]};
        if (w[0] == w[1] || w[1] == w[2] || w[2] == w[0]) continue;
        visit(w[0], w[1], p);
        visit(w[1], w[2], p);
        visit(w[2], w[0], p);
      }
  }

  std::vector<std::size_t> first_;  // use of each vertex, and their number
  std::vector<EdgeUse> uses_;
};

// An edge of a solid that does not have two triangles of opposite direction.
struct FaultyEdge {
  std::uint32_t solid = 0;
  std::uint32_t low = 0;  // vertices, low < high
  std::uint32_t high = 0;
  std::uint32_t count = 0;
};

// Collects those under one vertex, by solid and by their other vertex.
void find_faulty(std::uint32_t low, std::span<EdgeUse> uses, std::vector<FaultyEdge>& faulty) {
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& l, const EdgeUse& r) {
    return std::tie(l.solid, l.high) < std::tie(r.solid, r.high);
  });
  for (std::size_t i = 0; i < uses.size();) {
    FaultyEdge edge{uses[i].solid, low, uses[i].high, 0};
    int direction = 0;  // sum; 0 if the orientations agree
    for (; i < uses.size() && uses[i].solid == edge.solid && uses[i].high == edge.high; ++i) {
      ++edge.count;
      direction += uses[i].direction;
    }
    if (edge.count % 2 == 1 || direction != 0) faulty.push_back(edge);
  }
}

// Sorted by solid, low, high.
std::vector<FaultyEdge> faulty_edges(const TriangleMesh& mesh,
                                     const std::vector<std::uint32_t>& welded,
                                     const std::vector<std::uint32_t>& solid_of_part) {
  EdgeLists edges(mesh, welded, solid_of_part);
  using Range = tbb::blocked_range<std::uint32_t>;
  std::vector<FaultyEdge> faulty = tbb::parallel_reduce(
      Range(0, static_cast<std::uint32_t>(mesh.positions.size())), std::vector<FaultyEdge>(),
      [&](const Range& range, std::vector<FaultyEdge> found) {
        for (std::uint32_t low = range.begin(); low != range.end(); ++low)
          find_faulty(low, edges.under(low), found);
        return found;
      },
      [](std::vector<FaultyEdge> l, const std::vector<FaultyEdge>& r) {
        l.insert(l.end(), r.begin(), r.end());
        return l;
      });
  std::stable_sort(faulty.begin(), faulty.end(),
                   [](const FaultyEdge& l, const FaultyEdge& r) { return l.solid < r.solid; });
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

// Merges solids whose boundaries share an edge. Returns whether any were merged.
bool join_open_solids(const std::vector<FaultyEdge>& faulty,
                      std::vector<std::uint32_t>& solid_of_part) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> first_at;
  DisjointSets solids(static_cast<std::uint32_t>(solid_of_part.size()));
  bool joined = false;
  for (const FaultyEdge& edge : faulty) {
    if (edge.count != 1) continue;
    const auto [at, is_first] = first_at.try_emplace({edge.low, edge.high}, edge.solid);
    if (!is_first && solids.unite(at->second, edge.solid)) joined = true;
  }
  for (std::uint32_t& solid : solid_of_part) solid = solids.lowest(solid);
  return joined;
}

// All parts of a solid have one reference point: a single part may be open.
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

std::vector<SolidReport> check_solid(const TriangleMesh& mesh) {
  validate(mesh);
  return check_solid(mesh, weld_vertices(mesh));
}

std::vector<SolidReport> check_solid(const TriangleMesh& mesh,
                                     const std::vector<std::uint32_t>& welded) {
  std::vector<std::uint32_t> solid_of_part = solids_by_name(mesh);
  std::vector<FaultyEdge> faulty = faulty_edges(mesh, welded, solid_of_part);
  if (join_open_solids(faulty, solid_of_part)) faulty = faulty_edges(mesh, welded, solid_of_part);

  std::map<std::uint32_t, std::size_t> place;  // solid -> report
  std::vector<SolidReport> reports;
  for (std::uint32_t p = 0; p < mesh.parts.size(); ++p) {
    if (mesh.parts[p].triangle_count == 0) continue;
    const auto [at, is_new] = place.try_emplace(solid_of_part[p], reports.size());
    if (is_new) reports.emplace_back().part = mesh.parts[p].name;
    reports[at->second].parts.push_back(p);
  }
  for (SolidReport& report : reports) report.volume = volume_of(mesh, report.parts);
  for (const FaultyEdge& edge : faulty) {
    SolidReport& report = reports[place.at(edge.solid)];
    if (edge.count != 1) {
      ++report.nonmanifold_edges;
      continue;
    }
    if (report.boundary_edges++ == 0)
      report.first_hole = (mesh.positions[edge.low] + mesh.positions[edge.high]) / 2;
  }
  return reports;
}

}  // namespace springlod::voxelize
