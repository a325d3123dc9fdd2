#pragma once

#include <cstdint>
#include <vector>

#include "model/contact_surface.hpp"
#include "model/corners.hpp"
#include "model/dilatation.hpp"
#include "model/material.hpp"
#include "model/vec.hpp"

namespace springlod::inline model {

/// A mass-spring model: N nodes and S springs as a struct of arrays (docs/method.md, section 2).
/// Treat it as immutable once `validate` has passed; the moving quantities are a State.
///
/// The paper counts each spring at both ends: its S is 2 * spring_count() here ("ends").
struct MassSpringModel {
  // Nodes, N each.
  std::vector<Vec3> rest;               ///< rest position [m]
  std::vector<double> mass;             ///< [kg] > 0
  std::vector<double> volume;           ///< [m3] > 0; V of eq. 2
  std::vector<double> contact_area;     ///< [m2] >= 0; the node's share of the outer surface
  std::vector<std::uint8_t> border;     ///< 1 if the node lies on the surface
  std::vector<std::uint32_t> material;  ///< index into materials; the one with most of the volume

  // Springs, S each, sorted by (a, b), a < b, no pair twice; their ends do not coincide at rest.
  std::vector<std::uint32_t> a, b;
  std::vector<double> rest_length;  ///< L [m] > 0; |rest[b] - rest[a]| in every model built here
  std::vector<double> stiffness;    ///< k [N/m] > 0
  std::vector<double> damping;      ///< c [N s/m] >= 0

  /// Corners of cells, which keep the sign of their volume; sorted by their nodes. In models built
  /// here, no four nodes have two corners. Empty: nothing resists an inversion. validate_corners
  /// states the rules.
  std::vector<Corner> corners;

  /// What gives materials a Poisson's ratio other than 1/4; empty if all have 1/4.
  DilatationTerms dilatation;

  /// Where the body touches obstacles, if not at its nodes; empty: at those with a contact area.
  ContactSurface surface;

  std::vector<Material> materials;  ///< at least one

  std::uint32_t node_count() const { return static_cast<std::uint32_t>(rest.size()); }
  std::uint32_t spring_count() const { return static_cast<std::uint32_t>(a.size()); }
  std::uint32_t end_count() const { return 2 * spring_count(); }
  std::uint32_t corner_count() const { return static_cast<std::uint32_t>(corners.size()); }
};

/// Throws InputError with the first node, spring, corner or term that breaks a rule stated above.
void validate(const MassSpringModel& model);

/// Positions [m] and velocities [m/s] of the N nodes at time t [s].
struct State {
  std::vector<Vec3> x;
  std::vector<Vec3> v;
  double t = 0;
};

/// The rest positions with zero velocity, at t = 0.
State rest_state(const MassSpringModel& model);

/// Unit vector at rest from end a to end b of a spring.
inline Vec3 spring_direction(const MassSpringModel& model, std::uint32_t spring) {
  return (model.rest[model.b[spring]] - model.rest[model.a[spring]]).normalized();
}

/// Mass properties at rest.
struct MassProperties {
  double mass = 0;              ///< [kg]
  double volume = 0;            ///< [m3]
  Vec3 center = Vec3::Zero();   ///< centre of mass [m]
  Mat3 inertia = Mat3::Zero();  ///< of point masses about the centre of mass [kg m2]
};
MassProperties mass_properties(const MassSpringModel& model);

/// Centre of mass of the nodes at positions x [m]. If `x` holds velocities, the velocity of the
/// centre of mass [m/s].
Vec3 center_of_mass(const MassSpringModel& model, const std::vector<Vec3>& x);

std::uint32_t border_count(const MassSpringModel& model);

/// Connected components. They are numbered by their lowest node; `of_node` is the number of each
/// node's component.
struct Components {
  std::vector<std::uint32_t> of_node;  ///< N
  std::uint32_t count = 0;
};
Components connected_components(const MassSpringModel& model);

/// Mean of the rest lengths [m]; 0 without springs.
double mean_spring_length(const MassSpringModel& model);
/// Sum of k L^2 over the springs [N m]: W of eq. 2.
double spring_work(const MassSpringModel& model);
/// Young's modulus by eq. 2 [Pa], W / (6 V) without dilatation terms: an upper bound, which assumes
/// that nodes move affinely.
double estimated_young(const MassSpringModel& model);

}  // namespace springlod::inline model
