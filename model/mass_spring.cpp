#include "model/mass_spring.hpp"

#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "base/disjoint_sets.hpp"
#include "base/error.hpp"
#include "base/script_number.hpp"

namespace springlod::inline model {
namespace {

void require_sizes(const MassSpringModel& m) {
  const std::size_t n = m.rest.size();
  if (m.mass.size() != n || m.volume.size() != n || m.contact_area.size() != n ||
      m.border.size() != n || m.material.size() != n)
    throw InputError(fmt::format("model: every node array must have {} entries", n));
  const std::size_t s = m.a.size();
  if (m.b.size() != s || m.rest_length.size() != s || m.stiffness.size() != s ||
      m.damping.size() != s)
    throw InputError(fmt::format("model: every spring array must have {} entries", s));
}

void validate_nodes(const MassSpringModel& m) {
  for (std::uint32_t i = 0; i < m.node_count(); ++i) {
    const auto fail = [&](const char* rule) {
      throw InputError(fmt::format("model: node {}: {}", script_number(i), rule));
    };
    if (!m.rest[i].allFinite()) fail("its position is not finite");
    if (!(m.mass[i] > 0) || !std::isfinite(m.mass[i])) fail("its mass must be above 0");
    if (!(m.volume[i] > 0) || !std::isfinite(m.volume[i])) fail("its volume must be above 0");
    if (!(m.contact_area[i] >= 0) || !std::isfinite(m.contact_area[i]))
      fail("its contact area must be 0 or more");
    if (m.material[i] >= m.materials.size()) fail("its material number is out of range");
  }
}

void validate_springs(const MassSpringModel& m) {
  for (std::uint32_t s = 0; s < m.spring_count(); ++s) {
    const auto fail = [&](const char* rule) {
      throw InputError(fmt::format("model: spring {} ({} - {}): {}", script_number(s),
                                   script_number(m.a[s]), script_number(m.b[s]), rule));
    };
    if (m.b[s] >= m.node_count()) fail("it refers to a node that does not exist");
    if (m.a[s] >= m.b[s]) fail("its nodes must differ, the lower one first");
    if (s > 0 && (m.a[s - 1] > m.a[s] || (m.a[s - 1] == m.a[s] && m.b[s - 1] >= m.b[s])))
      fail("springs must be sorted by their nodes, no pair twice");
    if (m.rest[m.a[s]] == m.rest[m.b[s]]) fail("its nodes coincide; move or merge them");
    if (!(m.rest_length[s] > 0) || !std::isfinite(m.rest_length[s]))
      fail("its rest length must be above 0");
    if (!(m.stiffness[s] > 0) || !std::isfinite(m.stiffness[s]))
      fail("its stiffness must be above 0");
    if (!(m.damping[s] >= 0) || !std::isfinite(m.damping[s])) fail("its damping must be 0 or more");
  }
}

}  // namespace

void validate(const MassSpringModel& model) {
  if (model.rest.empty()) throw InputError("model: it has no nodes");
  if (model.materials.empty()) throw InputError("model: it has no materials; give at least one");
  for (const Material& material : model.materials) validate(material);
  require_sizes(model);
  validate_nodes(model);
  validate_springs(model);
  validate_corners(model);
}

State rest_state(const MassSpringModel& model) {
  return {model.rest, std::vector<Vec3>(model.rest.size(), Vec3::Zero()), 0};
}

MassProperties mass_properties(const MassSpringModel& model) {
  MassProperties p;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    p.mass += model.mass[i];
    p.volume += model.volume[i];
  }
  p.center = center_of_mass(model, model.rest);
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    const Vec3 r = model.rest[i] - p.center;
    p.inertia += model.mass[i] * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
  }
  return p;
}

Vec3 center_of_mass(const MassSpringModel& model, const std::vector<Vec3>& x) {
  Vec3 moment = Vec3::Zero();
  double mass = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    moment += model.mass[i] * x[i];
    mass += model.mass[i];
  }
  return moment / mass;
}

std::uint32_t border_count(const MassSpringModel& model) {
  return std::accumulate(model.border.begin(), model.border.end(), std::uint32_t{0});
}

Components connected_components(const MassSpringModel& model) {
  DisjointSets parts(model.node_count());
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) parts.unite(model.a[s], model.b[s]);
  DisjointSets::Numbers numbers = parts.numbers();
  return {std::move(numbers.of), numbers.count};
}

double mean_spring_length(const MassSpringModel& model) {
  if (model.spring_count() == 0) return 0;
  double sum = 0;
  for (const double length : model.rest_length) sum += length;
  return sum / model.spring_count();
}

double spring_work(const MassSpringModel& model) {
  double work = 0;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    work += model.stiffness[s] * model.rest_length[s] * model.rest_length[s];
  return work;
}

double estimated_young(const MassSpringModel& model) {
  return spring_work(model) / (6 * mass_properties(model).volume);
}

}  // namespace springlod::inline model
