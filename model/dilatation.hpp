#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "model/vec.hpp"

namespace springlod::inline model {

struct MassSpringModel;

/// Dilatation terms: what a change of volume costs beyond what springs make it cost. A network of
/// springs has Poisson's ratio 1/4; terms give it any other. A term measures the volume of some
/// nodes by their mean deformation gradient F = sum_j x_j b_j^T, J = det F, and has the energy
/// T eps(J)^2 / 2 (docs/method.md, section 2). F is the unit matrix at rest, so that eps = sum_j
/// b_j.u_j of small displacements. Forces and torques of a term add up to 0.
///
/// A `corners` lattice has a term for each cell, over its eight nodes, where F is the mean of the
/// cell; every other model has one for each node, over the node and its neighbours.
struct DilatationTerms {
  // Terms, T each.
  std::vector<double> modulus;       ///< T = Lambda V [J], not 0; below 0 if nu < 1/4
  std::vector<double> damping_time;  ///< beta [s] >= 0, as c / k of a spring
  // The nodes of term t are the entries start[t] to start[t + 1].
  std::vector<std::uint32_t> start;  ///< T + 1; empty without terms
  /// Ascending in each term, each once, all in one connected component.
  std::vector<std::uint32_t> node;
  std::vector<Vec3> gradient;  ///< b [1/m]; sum b = 0 and sum x b^T = 1 at rest

  std::uint32_t count() const { return static_cast<std::uint32_t>(modulus.size()); }
  bool empty() const { return modulus.empty(); }
  std::span<const std::uint32_t> nodes(std::uint32_t term) const {
    return {node.data() + start[term], node.data() + start[term + 1]};
  }
  std::span<const Vec3> gradients(std::uint32_t term) const {
    return {gradient.data() + start[term], gradient.data() + start[term + 1]};
  }

  void reserve(std::size_t terms, std::size_t nodes_of_all);
  /// Adds a term over ascending nodes.
  void add(double term_modulus, double term_damping_time, std::span<const std::uint32_t> nodes,
           std::span<const Vec3> gradients);
};

/// eps and its derivative by J.
struct Dilatation {
  double strain = 0;
  double slope = 0;
};

/// eps = J - 1; for T < 0 it is (J - 1) / sqrt(1 + (J - 1)^2), which is bounded: the energy that a
/// body could gain by expanding would not be, while that of its springs grows as the square of
/// their lengths (docs/method.md, eq. 8d).
inline Dilatation dilatation(double volume_ratio, double modulus) {
  const double change = volume_ratio - 1;
  if (modulus > 0) return {change, 1};
  const double bounded = 1 / std::sqrt(1 + change * change);
  return {change * bounded, bounded * bounded * bounded};
}

/// F of a term at the positions x [m], or of velocities its rate [1/s].
Mat3 mean_gradient(const DilatationTerms& terms, std::uint32_t term, const std::vector<Vec3>& x);
/// det F, and its derivative by F.
struct VolumeRatio {
  double value = 1;  ///< J
  Mat3 by_gradient = Mat3::Identity();
};
VolumeRatio volume_ratio(const Mat3& gradient);
/// eps = sum_j b_j.u_j of a term under small displacements u [m] about rest.
double linear_dilatation(const DilatationTerms& terms, std::uint32_t term,
                         const std::vector<Vec3>& u);

/// Energy of all terms [J] at the positions x [m].
double dilatation_energy(const DilatationTerms& terms, const std::vector<Vec3>& x);

/// The terms in shares of their nodes.
struct DilatationShares {
  std::vector<double> modulus;       ///< sum of the shares of T, N [J]
  std::vector<double> damping_time;  ///< their mean, N [s]
};
/// A node has the larger share in a term, the nearer it is to the middle of its nodes: the nodes of
/// a cell have equal shares, and most of the term of a node inside a body is that node's.
DilatationShares dilatation_shares(const MassSpringModel& model);

/// Throws InputError with the first term that breaks a rule stated above, or whose values are out
/// of range.
void validate_dilatation(const MassSpringModel& model);

}  // namespace springlod::inline model
