#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/material.hpp"
#include "model/vec.hpp"

namespace springlod::inline model {

/// A mass-spring model: N nodes and S springs, struct of arrays. Treat it as immutable once
/// `validate` has passed; what moves is a State.
///
/// The paper counts each spring at both ends: its S is 2 * spring_count() here ("ends").
struct MassSpringModel {
  // Nodes, N each.
  std::vector<Vec3> rest;               ///< rest position [m]
  std::vector<double> mass;             ///< [kg] > 0
  std::vector<double> volume;           ///< [m3] > 0; what eq. 2 of the paper sums up
  std::vector<double> contact_area;     ///< [m2] >= 0; outer surface the node stands for
  std::vector<std::uint8_t> border;     ///< 1 if the node lies on the surface
  std::vector<std::uint32_t> material;  ///< index into materials; the one with most of the volume

  // Springs, S each, sorted by (a, b), a < b, no pair twice; the ends lie apart at rest.
  std::vector<std::uint32_t> a, b;
  std::vector<double> rest_length;  ///< L [m] > 0; |rest[b] - rest[a]| in every model built here
  std::vector<double> stiffness;    ///< k [N/m] > 0
  std::vector<double> damping;      ///< c [N s/m] >= 0

  std::vector<Material> materials;  ///< at least one

  std::uint32_t node_count() const { return static_cast<std::uint32_t>(rest.size()); }
  std::uint32_t spring_count() const { return static_cast<std::uint32_t>(a.size()); }
  std::uint32_t end_count() const { return 2 * spring_count(); }
};

/// Throws InputError naming the first node or spring that breaks a rule stated above.
void validate(const MassSpringModel& model);

/// Positions [m] and velocities [m/s] of the N nodes at time t [s].
struct State {
  std::vector<Vec3> x;
  std::vector<Vec3> v;
  double t = 0;
};

/// At rest in the rest positions, t = 0.
State rest_state(const MassSpringModel& model);

/// Unit vector from a spring's end a to its end b at rest.
inline Vec3 spring_direction(const MassSpringModel& model, std::uint32_t spring) {
  return (model.rest[model.b[spring]] - model.rest[model.a[spring]]).normalized();
}

/// Sums and moments of the rest state.
struct MassProperties {
  double mass = 0;              ///< [kg]
  double volume = 0;            ///< [m3]
  Vec3 center = Vec3::Zero();   ///< centre of mass [m]
  Mat3 inertia = Mat3::Zero();  ///< of point masses about the centre of mass [kg m2]
};
MassProperties mass_properties(const MassSpringModel& model);

/// Centre of mass of the nodes at positions x [m]. Given their velocities: its velocity [m/s].
Vec3 center_of_mass(const MassSpringModel& model, const std::vector<Vec3>& x);

std::uint32_t border_count(const MassSpringModel& model);

/// Connected parts: the number of the part of each node, numbered by their lowest node.
struct Components {
  std::vector<std::uint32_t> of_node;  ///< N
  std::uint32_t count = 0;
};
Components connected_components(const MassSpringModel& model);

/// Mean of the rest lengths [m]; 0 without springs.
double mean_spring_length(const MassSpringModel& model);
/// sum of k L^2 over the springs [N m]: W of the paper's eq. 2.
double spring_work(const MassSpringModel& model);
/// Young's modulus by the paper's eq. 2, W / (6 V) [Pa]; an affine upper bound.
double estimated_young(const MassSpringModel& model);

}  // namespace springlod::inline model
