#include "lod/merging/merge.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"
#include "lod/merging/merge_corners.hpp"
#include "lod/merging/merge_dilatation.hpp"
#include "lod/merging/relink.hpp"

namespace springlod::lod {
namespace {

std::vector<std::uint32_t> group_sizes(const Groups& groups) {
  std::vector<std::uint32_t> size(groups.count, 0);
  for (const std::uint32_t g : groups.of) {
    assert(g < groups.count);
    ++size[g];
  }
  return size;
}

// The material with most of the group's volume; the lowest number in a tie.
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
  // m x / m differs from x by rounding; positions of single nodes are copied.
  for (std::uint32_t i = 0; i < fine.node_count(); ++i)
    if (size[groups.of[i]] == 1) coarse.rest[groups.of[i]] = fine.rest[i];
  coarse.material = main_materials(fine, groups);
}

// The rest length is the distance of the centres. A spring between two single nodes is the only one
// of its pair and keeps its rest length bit for bit.
void set_rest_lengths(const MassSpringModel& fine, const std::vector<std::uint32_t>& into,
                      const std::vector<std::uint32_t>& size, MassSpringModel& coarse) {
  coarse.rest_length.resize(coarse.spring_count());
  for (std::uint32_t p = 0; p < coarse.spring_count(); ++p) {
    const std::uint32_t a = coarse.a[p];
    const std::uint32_t b = coarse.b[p];
    coarse.rest_length[p] = (coarse.rest[b] - coarse.rest[a]).norm();
    if (!(coarse.rest_length[p] > 0))
      throw InputError(fmt::format(
          "merge: groups {} and {} are joined and have the same centre of mass, so their spring "
          "would be infinitely stiff; use guards = true, which fuses them",
          script_number(a), script_number(b)));
  }
  for (std::uint32_t s = 0; s < fine.spring_count(); ++s) {
    const std::uint32_t p = into[s];
    if (p == Relinking::kInside) continue;
    if (size[coarse.a[p]] == 1 && size[coarse.b[p]] == 1)
      coarse.rest_length[p] = fine.rest_length[s];
  }
}

// k = k0 L0 / L (the paper, section 4.2). The factor is exactly 1 for a spring that keeps its
// length.
void add_up_springs(const MassSpringModel& fine, const std::vector<std::uint32_t>& into,
                    MassSpringModel& coarse) {
  coarse.stiffness.assign(coarse.spring_count(), 0);
  coarse.damping.assign(coarse.spring_count(), 0);
  for (std::uint32_t s = 0; s < fine.spring_count(); ++s) {
    const std::uint32_t p = into[s];
    if (p == Relinking::kInside) continue;
    const double factor = fine.rest_length[s] / coarse.rest_length[p];
    coarse.stiffness[p] += fine.stiffness[s] * factor;
    coarse.damping[p] += fine.damping[s] * factor;
  }
}

}  // namespace

MassSpringModel merge(const MassSpringModel& fine, const Groups& groups) {
  return merge(fine, groups, relink(SpringRows(fine), groups));
}

MassSpringModel merge(const MassSpringModel& fine, const Groups& groups, Relinking links) {
  MassSpringModel coarse = merge_springs(fine, groups, std::move(links));
  coarse.corners = merge_corners(fine.corners, groups, coarse.rest);
  coarse.dilatation = merge_dilatation(fine, groups, coarse);
  return coarse;
}

MassSpringModel merge_springs(const MassSpringModel& fine, const Groups& groups, Relinking links) {
  assert(groups.of.size() == fine.node_count());
  assert(links.into.size() == fine.spring_count());
  assert(links.a.size() == links.b.size());
  const std::vector<std::uint32_t> size = group_sizes(groups);
  MassSpringModel coarse;
  coarse.materials = fine.materials;
  merge_nodes(fine, groups, size, coarse);
  coarse.a = std::move(links.a);
  coarse.b = std::move(links.b);
  set_rest_lengths(fine, links.into, size, coarse);
  add_up_springs(fine, links.into, coarse);
  return coarse;
}

}  // namespace springlod::lod
