#include "lod/grouping/grid_groups.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include <fmt/format.h>

#include "base/error.hpp"
#include "lod/grouping/connected_groups.hpp"
#include "lod/grouping/exact_count.hpp"
#include "model/point_bins.hpp"

namespace springlod::lod {
namespace {

constexpr double kStep = 1.01;  // from one edge tried to the next [1]

Groups cells_of(const MassSpringModel& model, const Vec3& origin, double edge) {
  std::map<std::array<std::int64_t, 3>, std::uint32_t> number;
  Groups groups;
  for (const Vec3& x : model.rest) {
    std::array<std::int64_t, 3> cell{};
    for (int d = 0; d < 3; ++d)
      cell[static_cast<std::size_t>(d)] = std::llround(std::floor((x[d] - origin[d]) / edge));
    groups.of.push_back(number.emplace(cell, number.size()).first->second);
  }
  groups.count = static_cast<std::uint32_t>(number.size());
  return groups;
}

}  // namespace

Groups grid_groups(const GroupingTask& task) {
  const std::uint32_t nodes = task.model.node_count();
  if (task.count == 0 || task.count > nodes)
    throw InputError(fmt::format("grid grouping: {} groups of {} nodes; ask for 1 to {}",
                                 task.count, nodes, nodes));
  const Box3 box = bounds(task.model.rest);
  double edge = box.sizes().maxCoeff() / std::cbrt(nodes) / 2;
  Groups groups = cells_of(task.model, box.min(), edge);
  for (; groups.count > task.count; edge *= kStep) groups = cells_of(task.model, box.min(), edge);
  connect_groups(task.model, groups);
  split_to_count(task.model, task.springs, task.count, groups);
  return groups;
}

}  // namespace springlod::lod
