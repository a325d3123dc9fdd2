#include "model/mass_spring.hpp"

#include <cmath>
#include <numeric>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/disjoint_sets.hpp"
#include "base/error.hpp"
#include "base/script_number.hpp"
#include "model/ranges.hpp"

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

void validate_node(const MassSpringModel& m, std::uint32_t i) {
  const auto fail = [&](std::string_view rule) {
    throw InputError(fmt::format("model: node {}: {}", script_number(i), rule));
  };
  const auto require = [&](const char* quantity, double value, const PhysicalRange& range) {
    if (!range.contains(value)) fail(outside(quantity, value, range));
  };
  for (const double coordinate : m.rest[i]) require("position", coordinate, range::kCoordinate);
  require("mass", m.mass[i], range::kMass);
  require("volume", m.volume[i], range::kVolume);
  require("contact area", m.contact_area[i],
          {0, range::kMostFolding * std::pow(m.volume[i], 2.0 / 3), "m2 for its volume"});
  if (m.border[i] > 1) fail("its border flag must be 0 or 1");
  if (m.material[i] >= m.materials.size()) fail("its material number is out of range");
}

void validate_spring(const MassSpringModel& m, std::uint32_t s) {
  const auto fail = [&](std::string_view rule) {
    throw InputError(fmt::format("model: spring {} ({} - {}): {}", script_number(s),
                                 script_number(m.a[s]), script_number(m.b[s]), rule));
  };
  const auto require = [&](const char* quantity, double value, const PhysicalRange& range) {
    if (!range.contains(value)) fail(outside(quantity, value, range));
  };
  if (m.b[s] >= m.node_count()) fail("it refers to a node that does not exist");
  if (m.a[s] >= m.b[s]) fail("its nodes must differ, the lower one first");
  if (s > 0 && (m.a[s - 1] > m.a[s] || (m.a[s - 1] == m.a[s] && m.b[s - 1] >= m.b[s])))
    fail("springs must be sorted by their nodes, no pair twice");
  const double distance = (m.rest[m.a[s]] - m.rest[m.b[s]]).norm();
  if (!(distance > 0)) fail("its nodes coincide; move or merge them");
  require("rest length", m.rest_length[s], range::kRestLength);
  require("rest length", m.rest_length[s],
          {range::kRestLength.least, range::kMostCompression * distance,
           "m for the distance of its nodes"});
  require("stiffness", m.stiffness[s], range::kStiffness);
  require("damping", m.damping[s],
          {0, range::kDampingTime.most * m.stiffness[s], "N s/m for its stiffness"});
}

}  // namespace

void validate(const MassSpringModel& model) {
  if (model.rest.empty()) throw InputError("model: it has no nodes");
  if (model.materials.empty()) throw InputError("model: it has no materials; give at least one");
  for (const Material& material : model.materials) validate(material);
  require_sizes(model);
  for (std::uint32_t i = 0; i < model.node_count(); ++i) validate_node(model, i);
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) validate_spring(model, s);
  validate_corners(model);
  validate_dilatation(model);
  if (!model.surface.empty()) validate(model.surface, model.node_count());
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
  const double volume = mass_properties(model).volume;
  const std::vector<double>& moduli = model.dilatation.modulus;
  const double dilatation = std::accumulate(moduli.begin(), moduli.end(), 0.0);
  return affine_young(spring_work(model), dilatation, volume);
}

}  // namespace springlod::inline model
