#include "voxelize/mesh/repair.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

#include <fmt/format.h>

#include "base/disjoint_sets.hpp"
#include "base/message.hpp"
#include "voxelize/mesh/thickness.hpp"
#include "voxelize/mesh/weld.hpp"

namespace springlod::voxelize {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// A triangle of a solid. Its corners are welded.
struct Face {
  std::uint32_t number = 0;  // in the mesh
  Triangle corners{};
  bool turn = false;
};

// An edge of a face, from the lower to the higher vertex.
struct EdgeUse {
  std::uint32_t low = 0, high = 0;
  std::uint32_t face = 0;  // among those of the solid
  bool upwards = false;    // whether the face runs from low to high
};

struct Hole {
  Vec3 middle = Vec3::Zero();  // sum over the ends of its edges
  double edges = 0;
  Vec3 area = Vec3::Zero();  // of its fan
};

/// The faces of one solid, their edges and how they turn.
class SolidFaces {
 public:
  SolidFaces(const TriangleMesh& mesh, const SolidReport& solid,
             const std::vector<std::uint32_t>& welded)
      : mesh_(mesh) {
    report_.part = solid.part;
    gather(solid, welded);
    report_.without_area = faces_.empty();
    remove_doubled();
    list_edges();
    turn_against_neighbours();
    turn_outwards();
    measure_holes();
  }

  const std::vector<Face>& faces() const { return faces_; }
  const SolidRepair& report() const { return report_; }

 private:
  void gather(const SolidReport& solid, const std::vector<std::uint32_t>& welded) {
    for (const std::uint32_t p : solid.parts)
      for (std::uint32_t i = 0; i < mesh_.parts[p].triangle_count; ++i) {
        const std::uint32_t number = mesh_.parts[p].first_triangle + i;
        const Triangle& t = mesh_.triangles[number];
        const Triangle w{welded[t[0]], welded[t[1]], welded[t[2]]};
        if (w[0] != w[1] && w[1] != w[2] && w[2] != w[0]) faces_.push_back({number, w});
      }
  }

  // Of those with the same corners, in any order, the first stays.
  void remove_doubled() {
    const auto key = [](const Face& face) {
      Triangle sorted = face.corners;
      std::sort(sorted.begin(), sorted.end());
      return sorted;
    };
    std::stable_sort(faces_.begin(), faces_.end(),
                     [&](const Face& l, const Face& r) { return key(l) < key(r); });
    const auto end = std::unique(faces_.begin(), faces_.end(),
                                 [&](const Face& l, const Face& r) { return key(l) == key(r); });
    report_.doubled = static_cast<std::uint64_t>(faces_.end() - end);
    faces_.erase(end, faces_.end());
    std::sort(faces_.begin(), faces_.end(),
              [](const Face& l, const Face& r) { return l.number < r.number; });
  }

  void list_edges() {
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t from = faces_[f].corners[i];
        const std::uint32_t to = faces_[f].corners[(i + 1) % 3];
        edges_.push_back({std::min(from, to), std::max(from, to), f, from < to});
      }
    std::sort(edges_.begin(), edges_.end(), [](const EdgeUse& l, const EdgeUse& r) {
      return std::tie(l.low, l.high, l.face) < std::tie(r.low, r.high, r.face);
    });
  }

  // Calls visit(first, count) with the uses of each edge.
  template <class Visit>
  void for_each_edge(Visit visit) const {
    for (std::size_t i = 0; i < edges_.size();) {
      std::size_t end = i;
      while (end < edges_.size() && edges_[end].low == edges_[i].low &&
             edges_[end].high == edges_[i].high)
        ++end;
      visit(&edges_[i], end - i);
      i = end;
    }
  }

  // Faces that share an edge with no third one face the same way.
  void turn_against_neighbours() {
    struct Neighbour {
      std::uint32_t face = kNone;
      bool against = false;
    };
    std::vector<std::array<Neighbour, 3>> neighbours(faces_.size());
    std::vector<std::uint8_t> known(faces_.size(), 0);
    const auto join = [&](const EdgeUse& of, const EdgeUse& with) {
      neighbours[of.face][known[of.face]++] = {with.face, of.upwards == with.upwards};
    };
    for_each_edge([&](const EdgeUse* use, std::size_t count) {
      if (count > 2) ++report_.crossing_edges;
      if (count != 2) return;
      join(use[0], use[1]);
      join(use[1], use[0]);
    });
    std::vector<std::uint8_t> seen(faces_.size(), 0);
    std::vector<std::uint32_t> patch;
    for (std::uint32_t start = 0; start < faces_.size(); ++start) {
      if (seen[start] != 0) continue;
      seen[start] = 1;
      patch.assign(1, start);
      for (std::size_t next = 0; next < patch.size(); ++next)
        for (const Neighbour& to : neighbours[patch[next]]) {
          if (to.face == kNone || seen[to.face] != 0) continue;
          seen[to.face] = 1;
          faces_[to.face].turn = faces_[patch[next]].turn != to.against;
          patch.push_back(to.face);
        }
      keep_the_most(patch);
    }
  }

  // Turns the smaller area of a patch.
  void keep_the_most(const std::vector<std::uint32_t>& patch) {
    double area = 0;  // turned minus kept
    for (const std::uint32_t f : patch)
      area += (faces_[f].turn ? 1 : -1) * vector_area(faces_[f]).norm();
    for (const std::uint32_t f : patch) {
      if (area > 0) faces_[f].turn = !faces_[f].turn;
      if (faces_[f].turn) ++report_.turned;
    }
  }

  void turn_outwards() {
    for (const Face& face : faces_)
      report_.volume +=
          (face.turn ? -1 : 1) * vector_area(face).dot(corner(face, 0) - origin()) / 3;
    report_.inside_out = report_.volume < 0;
    if (!report_.inside_out) return;
    report_.volume = -report_.volume;
    for (Face& face : faces_) face.turn = !face.turn;
  }

  void measure_holes() {
    std::vector<const EdgeUse*> open;
    for_each_edge([&](const EdgeUse* use, std::size_t count) {
      if (count == 1) open.push_back(use);
    });
    report_.open_edges = open.size();
    if (open.empty()) return;
    // Numbers of the vertices at holes.
    std::vector<std::uint32_t> vertices;
    for (const EdgeUse* edge : open) vertices.insert(vertices.end(), {edge->low, edge->high});
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    const auto place = [&](std::uint32_t v) {
      return static_cast<std::uint32_t>(std::lower_bound(vertices.begin(), vertices.end(), v) -
                                        vertices.begin());
    };
    DisjointSets groups(static_cast<std::uint32_t>(vertices.size()));
    for (const EdgeUse* edge : open) groups.unite(place(edge->low), place(edge->high));
    std::vector<Hole> holes(vertices.size());  // by the lowest vertex of a group
    for (const EdgeUse* edge : open) {
      Hole& hole = holes[groups.lowest(place(edge->low))];
      hole.middle += mesh_.positions[edge->low] + mesh_.positions[edge->high];
      ++hole.edges;
    }
    for (const EdgeUse* edge : open) {
      Hole& hole = holes[groups.lowest(place(edge->low))];
      const Vec3 middle = hole.middle / (2 * hole.edges);
      // The fan runs against the face.
      const bool upwards = edge->upwards == faces_[edge->face].turn;
      const Vec3 area =
          (upwards ? 0.5 : -0.5) *
          (mesh_.positions[edge->low] - middle).cross(mesh_.positions[edge->high] - middle);
      hole.area += area;
      report_.volume += area.dot(middle - origin()) / 3;
    }
    for (const Hole& hole : holes) {
      if (hole.edges > 0) ++report_.holes;
      report_.hole_area += hole.area.norm();
    }
  }

  // Near the solid: far from it, cancellation would lose digits.
  const Vec3& origin() const { return corner(faces_.front(), 0); }
  const Vec3& corner(const Face& face, std::size_t i) const {
    return mesh_.positions[face.corners[i]];
  }
  Vec3 vector_area(const Face& face) const {
    return (corner(face, 1) - corner(face, 0)).cross(corner(face, 2) - corner(face, 0)) / 2;
  }

  const TriangleMesh& mesh_;
  std::vector<Face> faces_;     // in the order of the mesh
  std::vector<EdgeUse> edges_;  // sorted by vertices
  SolidRepair report_;
};

}  // namespace

RepairedMesh repair(const TriangleMesh& mesh, const std::vector<SolidReport>& solids,
                    const std::vector<std::uint32_t>& welded) {
  RepairedMesh repaired;
  std::vector<std::uint8_t> keep(mesh.triangles.size(), 1);
  std::vector<Triangle> triangles = mesh.triangles;
  for (const SolidReport& solid : solids) {
    if (solid.faultless()) {
      repaired.solids.push_back({.part = solid.part, .volume = solid.volume});
      continue;
    }
    for (const std::uint32_t p : solid.parts)
      std::fill_n(keep.begin() + mesh.parts[p].first_triangle, mesh.parts[p].triangle_count, 0);
    const SolidFaces faces(mesh, solid, welded);
    for (const Face& face : faces.faces()) {
      keep[face.number] = 1;
      if (face.turn) std::swap(triangles[face.number][1], triangles[face.number][2]);
    }
    repaired.solids.push_back(faces.report());
  }
  repaired.mesh.positions = mesh.positions;
  for (MeshPart part : mesh.parts) {
    const std::uint32_t first = part.first_triangle;
    part.first_triangle = static_cast<std::uint32_t>(repaired.mesh.triangles.size());
    for (std::uint32_t t = first; t < first + part.triangle_count; ++t)
      if (keep[t] != 0) repaired.mesh.triangles.push_back(triangles[t]);
    part.triangle_count =
        static_cast<std::uint32_t>(repaired.mesh.triangles.size()) - part.first_triangle;
    repaired.mesh.parts.push_back(part);
  }
  return repaired;
}

std::vector<SolidRepair> find_faults(const TriangleMesh& mesh) {
  const std::vector<std::uint32_t> welded = weld_vertices(mesh);
  const std::vector<SolidReport> solids = check_solid(mesh, welded);
  std::vector<SolidRepair> found = repair(mesh, solids, welded).solids;
  for (std::size_t s = 0; s < solids.size(); ++s)
    found[s].thickness = thickness(mesh, solids[s], found[s].volume);
  return found;
}

std::vector<std::string> describe(const SolidRepair& repair) {
  std::vector<std::string> lines;
  const auto say = [&](const std::string& text) {
    lines.push_back(fmt::format("part \"{}\": {}", repair.part, text));
  };
  if (repair.without_area) say("its triangles have no area; left out");
  if (repair.inside_out) say("all triangles faced inwards; turned");
  if (repair.turned > 0)
    say(counted(repair.turned, "triangle") + " faced against their neighbours; turned");
  if (repair.doubled > 0) say(counted(repair.doubled, "doubled triangle") + " removed");
  if (repair.crossing_edges > 0)
    say(counted(repair.crossing_edges, "edge") + " with more than two triangles; check the result");
  if (repair.holes > 0)
    say(fmt::format("{} ({}, {:.3g} cm2) closed", counted(repair.holes, "hole"),
                    counted(repair.open_edges, "open edge"), 1e4 * repair.hole_area));
  return lines;
}

}  // namespace springlod::voxelize
