#include "lod/grouping/metis_groups.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#ifdef SPRINGLOD_HAS_METIS
#include <metis.h>
#endif

#include "base/error.hpp"
#include "lod/grouping/connected_groups.hpp"
#include "lod/grouping/exact_count.hpp"
#include "model/spring_rows.hpp"

namespace springlod::lod {

#ifdef SPRINGLOD_HAS_METIS

namespace {

/// Integer weight of the edge with the largest k L^2; METIS takes integer weights.
constexpr double kLargestWeight = 10000;

/// Renumbers the groups without those that METIS left empty.
Groups without_gaps(const std::vector<idx_t>& part, std::uint32_t count) {
  std::vector<std::uint32_t> number(count, 0);
  for (const idx_t p : part) number[static_cast<std::size_t>(p)] = 1;
  Groups groups;
  for (std::uint32_t& each : number) each = each != 0 ? groups.count++ : 0;
  for (const idx_t p : part) groups.of.push_back(number[static_cast<std::size_t>(p)]);
  return groups;
}

/// A partition of the nodes into `count` parts, the part of each node.
std::vector<idx_t> partition(const MassSpringModel& model, const SpringRows& springs,
                             std::uint32_t count, std::uint64_t seed) {
  std::vector<double> work;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    work.push_back(model.stiffness[s] * model.rest_length[s] * model.rest_length[s]);
  const double most = work.empty() ? 1 : *std::max_element(work.begin(), work.end());
  std::vector<idx_t> start{0}, neighbour, weight;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    springs.for_each(i, [&](std::uint32_t j, std::uint32_t s) {
      neighbour.push_back(static_cast<idx_t>(j));
      weight.push_back(
          std::max<idx_t>(1, static_cast<idx_t>(std::lround(kLargestWeight * work[s] / most))));
    });
    start.push_back(static_cast<idx_t>(neighbour.size()));
  }
  std::vector<idx_t> options(METIS_NOPTIONS);
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_SEED] = static_cast<idx_t>(seed % 0x7fffffff);
  auto nodes = static_cast<idx_t>(model.node_count());
  idx_t constraints = 1, cut = 0;
  auto parts = static_cast<idx_t>(count);
  std::vector<idx_t> part(model.node_count(), 0);
  if (count > 1 && METIS_PartGraphRecursive(&nodes, &constraints, start.data(), neighbour.data(),
                                            nullptr, nullptr, weight.data(), &parts, nullptr,
                                            nullptr, options.data(), &cut, part.data()) != METIS_OK)
    throw InputError(fmt::format("metis grouping: METIS failed to make {} groups of {} nodes",
                                 count, model.node_count()));
  return part;
}

}  // namespace

Groups metis_groups(const MassSpringModel& model, std::uint32_t count, std::uint64_t seed) {
  if (count == 0 || count > model.node_count())
    throw InputError(fmt::format("metis grouping: {} nodes cannot form {} groups; use 1 to {}",
                                 model.node_count(), count, model.node_count()));
  const SpringRows springs(model);
  Groups groups = without_gaps(partition(model, springs, count, seed), count);
  connect_groups(model, groups);
  split_to_count(model, springs, count, groups);
  return groups;
}

#else

Groups metis_groups(const MassSpringModel& /*model*/, std::uint32_t /*count*/,
                    std::uint64_t /*seed*/) {
  throw InputError(
      "metis grouping: springlod was built without METIS; use the grouping compact, or install "
      "libmetis-dev and build springlod again");
}

#endif

Groups metis_groups(const GroupingTask& task) {
  return metis_groups(task.model, task.count, task.options.seed);
}

}  // namespace springlod::lod
