#include "lod/merge.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "model/error.hpp"

namespace springlod {
namespace {

std::vector<std::uint32_t> group_sizes(const Groups& groups) {
  std::vector<std::uint32_t> size(groups.count, 0);
  for (const std::uint32_t g : groups.of) ++size[g];
  return size;
}

// The material with most of the group's volume; the lower number wins a tie.
std::vector<std::uint32_t> main_materials(const MassSpringModel& fine, const Groups& groups) {
  const std::size_t kinds = fine.materials.size();
  std::vector<double> volume(groups.count * kinds, 0);
  for (std::uint32_t i = 0; i < fine.node_count(); ++i)
    volume[groups.of[i] * kinds + fine.material[i]] += fine.volume[i];
  std::vector<std::uint32_t> material(groups.count);
  for (std::uint32_t g = 0; g < groups.count; ++g) {
    const auto first = volume.begin() + static_cast<std::ptrdiff_t>(g * kinds);
    material[g] = static_cast<std::uint32_t>(
        std::max_element(first, first + static_cast<std::ptrdiff_t>(kinds)) - first);
  }
  return material;
}

void merge_nodes(const MassSpringModel& fine, const Groups& groups,
                 const std::vector<std::uint32_t>& size, MassSpringModel& coarse) {
  coarse.rest.assign(groups.count, Vec3::Zero());
  coarse.mass.assign(groups.count, 0);
  coarse.volume.assign(groups.count, 0);
  coarse.contact_area.assign(groups.count, 0);
  coarse.border.assign(groups.count, 0);
  for (std::uint32_t i = 0; i < fine.node_count(); ++i) {
    const std::uint32_t g = groups.of[i];
    coarse.rest[g] += fine.mass[i] * fine.rest[i];
    coarse.mass[g] += fine.mass[i];
    coarse.volume[g] += fine.volume[i];
    coarse.contact_area[g] += fine.contact_area[i];
    coarse.border[g] |= fine.border[i];
  }
  for (std::uint32_t g = 0; g < groups.count; ++g) coarse.rest[g] /= coarse.mass[g];
  // m x / m is not x to the last bit; what was not merged keeps its bits.
  for (std::uint32_t i = 0; i < fine.node_count(); ++i)
    if (size[groups.of[i]] == 1) coarse.rest[groups.of[i]] = fine.rest[i];
  coarse.material = main_materials(fine, groups);
}

struct Reattached {
  std::uint32_t a, b;
  std::uint32_t spring;  // of the fine model
};

// Springs between groups, sorted by (a, b) and then by their fine number. Two counting passes sort
// by the pair in linear time.
std::vector<Reattached> reattached_springs(const MassSpringModel& fine, const Groups& groups) {
  std::vector<Reattached> springs;
  springs.reserve(fine.spring_count());
  for (std::uint32_t s = 0; s < fine.spring_count(); ++s) {
    const auto [low, high] = std::minmax(groups.of[fine.a[s]], groups.of[fine.b[s]]);
    if (low != high) springs.push_back({low, high, s});
  }
  std::vector<Reattached> sorted(springs.size());
  const auto counting_pass = [&](std::uint32_t Reattached::*key) {
    std::vector<std::uint32_t> next(groups.count + 1, 0);
    for (const Reattached& r : springs) ++next[r.*key + 1];
    for (std::uint32_t g = 0; g < groups.count; ++g) next[g + 1] += next[g];
    for (const Reattached& r : springs) sorted[next[r.*key]++] = r;
    springs.swap(sorted);
  };
  counting_pass(&Reattached::b);
  counting_pass(&Reattached::a);
  return springs;
}

void append_spring(MassSpringModel& model, std::uint32_t a, std::uint32_t b, double length) {
  model.a.push_back(a);
  model.b.push_back(b);
  model.rest_length.push_back(length);
  model.stiffness.push_back(0);
  model.damping.push_back(0);
}

void merge_springs(const MassSpringModel& fine, const Groups& groups,
                   const std::vector<std::uint32_t>& size, MassSpringModel& coarse) {
  for (const Reattached& r : reattached_springs(fine, groups)) {
    const bool unmerged = size[r.a] == 1 && size[r.b] == 1;
    if (coarse.a.empty() || coarse.a.back() != r.a || coarse.b.back() != r.b) {
      const double length =
          unmerged ? fine.rest_length[r.spring] : (coarse.rest[r.b] - coarse.rest[r.a]).norm();
      if (!(length > 0))
        throw InputError(fmt::format(
            "merge: groups {} and {} are joined and have the same centre of mass, so their spring "
            "would be infinitely stiff; fuse them (guards = true does)",
            r.a, r.b));
      append_spring(coarse, r.a, r.b, length);
    }
    // The paper: k = k0 L0 / L. For an unmerged spring the factor is exactly 1.
    const double factor = unmerged ? 1 : fine.rest_length[r.spring] / coarse.rest_length.back();
    coarse.stiffness.back() += fine.stiffness[r.spring] * factor;
    coarse.damping.back() += fine.damping[r.spring] * factor;
  }
}

}  // namespace

MassSpringModel merge(const MassSpringModel& fine, const Groups& groups) {
  if (groups.of.size() != fine.node_count())
    throw InputError(fmt::format("merge: the groups are of {} nodes, the model has {}",
                                 groups.of.size(), fine.node_count()));
  validate(groups);
  const std::vector<std::uint32_t> size = group_sizes(groups);
  MassSpringModel coarse;
  coarse.materials = fine.materials;
  merge_nodes(fine, groups, size, coarse);
  merge_springs(fine, groups, size, coarse);
  return coarse;
}

}  // namespace springlod
