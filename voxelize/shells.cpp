#include "voxelize/shells.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/disjoint_sets.hpp"

namespace springlod::voxelize {
namespace {

struct Shell {
  std::vector<Triangle> triangles;
  double volume = 0;  // signed
  Box3 box;
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
    for (const std::uint32_t v : t) shell.box.extend(mesh.positions[v]);
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

Shells sort(std::vector<Shell> all, const SolidReport& solid) {
  Shells sorted;
  const double facing = solid.volume < 0 ? -1 : 1;
  sorted.turned = facing < 0;
  const auto is_cavity = [&](const Shell& shell) {
    return shell.volume * facing < 0 &&
           std::any_of(all.begin(), all.end(), [&](const Shell& other) {
             return other.volume * facing > 0 && other.box.contains(shell.box);
           });
  };
  for (Shell& shell : all) {
    const bool cavity = is_cavity(shell);
    if (!cavity && shell.volume * facing < 0) sorted.turned = true;
    sorted.volume += (cavity ? -1 : 1) * std::abs(shell.volume);
    auto& into = cavity ? sorted.cavity : sorted.outer;
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
    sorted.push_back(sort(split(mesh, solid, welded, sets), solid));
  return sorted;
}

}  // namespace springlod::voxelize
