#include "voxelize/mesh/shells.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "voxelize/mesh/winding.hpp"

namespace springlod::voxelize {
namespace {

constexpr double kInside = 0.5;  // winding number above which a point is inside [1]

struct Shell {
  std::vector<Triangle> triangles;
  double volume = 0;  // signed
};

template <typename Visit>
void for_each_triangle(const TriangleMesh& mesh, const SolidReport& solid, Visit visit) {
  for (const std::uint32_t p : solid.parts)
    for (std::uint32_t i = 0; i < mesh.parts[p].triangle_count; ++i)
      visit(mesh.triangles[mesh.parts[p].first_triangle + i]);
}

// `sets` is reused for all solids, so that many small ones cost no more than one large one.
std::vector<Shell> split(const TriangleMesh& mesh, const SolidReport& solid,
                         const std::vector<std::uint32_t>& welded, DisjointSets& sets) {
  for_each_triangle(mesh, solid, [&](const Triangle& t) {
    for (const std::uint32_t v : t) sets.separate(welded[v]);
  });
  for_each_triangle(mesh, solid, [&](const Triangle& t) {
    sets.unite(welded[t[0]], welded[t[1]]);
    sets.unite(welded[t[0]], welded[t[2]]);
  });
  std::map<std::uint32_t, Shell> shells;
  for_each_triangle(mesh, solid, [&](const Triangle& t) {
    const std::uint32_t root = sets.lowest(welded[t[0]]);
    Shell& shell = shells[root];
    shell.triangles.push_back(t);
    const Vec3& o = mesh.positions[root];
    shell.volume +=
        (mesh.positions[t[0]] - o).dot((mesh.positions[t[1]] - o).cross(mesh.positions[t[2]] - o)) /
        6;
  });
  std::vector<Shell> list;
  list.reserve(shells.size());
  for (auto& [root, shell] : shells) list.push_back(std::move(shell));
  return list;
}

// Winding number of the shells that face as the solid as a whole.
WindingNumber outer_surface(const TriangleMesh& mesh, const std::vector<Shell>& all,
                            double facing) {
  std::vector<Triangle> triangles;
  for (const Shell& shell : all)
    if (shell.volume * facing > 0)
      triangles.insert(triangles.end(), shell.triangles.begin(), shell.triangles.end());
  return {mesh.positions, triangles};
}

void turn(std::vector<Triangle>& triangles) {
  for (Triangle& t : triangles) std::swap(t[1], t[2]);
}

Shells sort(const TriangleMesh& mesh, std::vector<Shell> all, const SolidReport& solid) {
  Shells sorted;
  const double facing = solid.volume < 0 ? -1 : 1;
  sorted.turned = facing < 0;
  sorted.count = all.size();
  std::optional<WindingNumber> outer;
  const auto is_cavity = [&](const Shell& shell) {
    if (shell.volume * facing >= 0) return false;
    if (!outer) outer = outer_surface(mesh, all, facing);
    return facing * outer->at(mesh.positions[shell.triangles.front()[0]]) > kInside;
  };
  std::vector<std::uint8_t> cavity;
  for (const Shell& shell : all) cavity.push_back(is_cavity(shell) ? 1 : 0);
  for (std::size_t n = 0; n < all.size(); ++n) {
    Shell& shell = all[n];
    if (cavity[n] == 0 && shell.volume * facing < 0) sorted.turned = true;
    sorted.volume += (cavity[n] != 0 ? -1 : 1) * std::abs(shell.volume);
    if (solid.closed() && (cavity[n] != 0) != (shell.volume < 0)) turn(shell.triangles);
    auto& into = cavity[n] != 0 ? sorted.cavity : sorted.outer;
    if (into.empty())
      into = std::move(shell.triangles);
    else
      into.insert(into.end(), shell.triangles.begin(), shell.triangles.end());
  }
  return sorted;
}

}  // namespace

std::vector<Shells> sort_shells(const TriangleMesh& mesh, const std::vector<SolidReport>& solids,
                                const std::vector<std::uint32_t>& welded) {
  DisjointSets sets(static_cast<std::uint32_t>(mesh.positions.size()));
  std::vector<Shells> sorted;
  sorted.reserve(solids.size());
  for (const SolidReport& solid : solids)
    sorted.push_back(sort(mesh, split(mesh, solid, welded, sets), solid));
  return sorted;
}

}  // namespace springlod::voxelize
