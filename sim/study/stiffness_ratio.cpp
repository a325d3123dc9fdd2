#include "sim/study/stiffness_ratio.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"

namespace springlod::sim {
namespace {

double harmonic_mean(double p, double q) {
  return 2 * p * q / (p + q);
}

StiffPart by_material(const MassSpringModel& base, double softest) {
  StiffPart part;
  part.softest = softest;
  std::vector<bool> named(base.materials.size(), false);
  for (const std::uint32_t m : base.material) {
    const Material& material = base.materials[m];
    const bool stiff = material.young > softest;
    part.of_node.push_back(stiff ? 1 : 0);
    part.ratio.push_back(material.young / softest);
    if (!stiff || named[m]) continue;
    named[m] = true;
    part.name += (part.name.empty() ? "" : ", ") + material.name;
  }
  return part;
}

StiffPart by_half(const MassSpringModel& base, double young) {
  Eigen::Index axis = 0;
  bounds(base.rest).sizes().maxCoeff(&axis);
  const double middle = mass_properties(base).center[axis];
  StiffPart part;
  part.softest = young;
  part.name = fmt::format("the half beyond the center of mass along {}", "xyz"[axis]);
  part.ratio.assign(base.node_count(), 1);
  for (const Vec3& point : base.rest) part.of_node.push_back(point[axis] > middle ? 1 : 0);
  if (std::find(part.of_node.begin(), part.of_node.end(), 1) == part.of_node.end())
    throw InputError("stiffness ratio: the body has one material and no far half to make stiff");
  return part;
}

/// Factor of change of each spring of the base.
std::vector<double> base_factors(const MassSpringModel& base, const StiffPart& part, double ratio) {
  const auto wanted = [&](std::uint32_t node) { return part.of_node[node] != 0 ? ratio : 1; };
  std::vector<double> factor;
  for (std::uint32_t s = 0; s < base.spring_count(); ++s) {
    const std::uint32_t a = base.a[s];
    const std::uint32_t b = base.b[s];
    factor.push_back(harmonic_mean(wanted(a), wanted(b)) /
                     harmonic_mean(part.ratio[a], part.ratio[b]));
  }
  return factor;
}

/// Number of the spring between two nodes; the largest uint32 if there is none.
std::uint32_t find_spring(const MassSpringModel& model, std::uint32_t a, std::uint32_t b) {
  if (a > b) std::swap(a, b);
  const auto first = std::lower_bound(model.a.begin(), model.a.end(), a) - model.a.begin();
  const auto last = std::upper_bound(model.a.begin(), model.a.end(), a) - model.a.begin();
  const auto found = std::lower_bound(model.b.begin() + first, model.b.begin() + last, b);
  if (found == model.b.begin() + last || *found != b)
    return std::numeric_limits<std::uint32_t>::max();
  return static_cast<std::uint32_t>(found - model.b.begin());
}

/// Factor by which the stiffness around each node changes, averaged over the volume of its group.
/// It is used for springs of a level that replace no spring of the base.
std::vector<double> group_factors(const MassSpringModel& base, const StiffPart& part,
                                  const Groups& groups, double ratio) {
  std::vector<double> before(groups.count, 0);
  std::vector<double> after(groups.count, 0);
  for (std::uint32_t i = 0; i < base.node_count(); ++i) {
    before[groups.of[i]] += base.volume[i] * part.ratio[i];
    after[groups.of[i]] += base.volume[i] * (part.of_node[i] != 0 ? ratio : 1);
  }
  for (std::uint32_t g = 0; g < groups.count; ++g) after[g] /= before[g];
  return after;
}

std::vector<double> level_factors(const MassSpringModel& base, const StiffPart& part,
                                  const std::vector<double>& of_base, const Level& level,
                                  double ratio) {
  const MassSpringModel& model = level.model;
  std::vector<double> before(model.spring_count(), 0);
  std::vector<double> after(model.spring_count(), 0);
  for (std::uint32_t s = 0; s < base.spring_count(); ++s) {
    const std::uint32_t spring =
        find_spring(model, level.of_base.of[base.a[s]], level.of_base.of[base.b[s]]);
    if (spring >= model.spring_count()) continue;
    const double force = base.stiffness[s] * base.rest_length[s];  // of strain 1
    before[spring] += force;
    after[spring] += force * of_base[s];
  }
  const std::vector<double> by_group = group_factors(base, part, level.of_base, ratio);
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    after[s] = before[s] > 0 ? after[s] / before[s]
                             : harmonic_mean(by_group[model.a[s]], by_group[model.b[s]]);
  return after;
}

/// A dilatation term changes as the springs at its nodes do in the mean.
void scale_terms(MassSpringModel& model, const std::vector<double>& factor_of_spring) {
  std::vector<double> sum(model.node_count(), 0), count(model.node_count(), 0);
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    for (const std::uint32_t node : {model.a[s], model.b[s]}) {
      sum[node] += factor_of_spring[s];
      count[node] += 1;
    }
  DilatationTerms& terms = model.dilatation;
  for (std::uint32_t t = 0; t < terms.count(); ++t) {
    double factor = 0;
    for (const std::uint32_t node : terms.nodes(t))
      factor += count[node] > 0 ? sum[node] / count[node] : 1;
    terms.modulus[t] *= factor / static_cast<double>(terms.nodes(t).size());
  }
}

void scale_springs(MassSpringModel& model, const std::vector<double>& factor) {
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    model.stiffness[s] *= factor[s];
    model.damping[s] *= factor[s];
  }
  if (!model.dilatation.empty()) scale_terms(model, factor);
}

/// Reports show the materials, so they are changed too, except in a body of one material.
void scale_materials(MassSpringModel& model, double softest, double ratio) {
  for (Material& material : model.materials)
    if (material.young > softest) material.young = ratio * softest;
}

}  // namespace

StiffPart stiff_part(const MassSpringModel& base) {
  double softest = std::numeric_limits<double>::infinity();
  double stiffest = 0;
  for (const std::uint32_t m : base.material) {
    softest = std::min(softest, base.materials[m].young);
    stiffest = std::max(stiffest, base.materials[m].young);
  }
  return stiffest > softest ? by_material(base, softest) : by_half(base, softest);
}

LodChain with_stiffness_ratio(const LodChain& chain, const StiffPart& part, double ratio) {
  if (!(std::isfinite(ratio) && ratio > 0))
    throw InputError(fmt::format("stiffness ratio: {} must be a finite number above 0", ratio));
  const MassSpringModel& base = chain.levels.front().model;
  const std::vector<double> of_base = base_factors(base, part, ratio);
  LodChain rescaled = chain;
  for (std::size_t level = 0; level < chain.levels.size(); ++level) {
    MassSpringModel& model = rescaled.levels[level].model;
    scale_springs(model, level == 0
                             ? of_base
                             : level_factors(base, part, of_base, chain.levels[level], ratio));
    scale_materials(model, part.softest, ratio);
  }
  return rescaled;
}

}  // namespace springlod::sim
