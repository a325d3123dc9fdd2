#pragma once

#include <cstdint>
#include <vector>

#include "model/binding.hpp"
#include "model/vec.hpp"

namespace springlod::inline model {

/// The surface of a body that its nodes do not lie on, as P points at which it touches obstacles in
/// place of its nodes (docs/method.md, eq. 64b).
struct ContactSurface {
  Binding of_nodes;          ///< P rows
  std::vector<Vec3> normal;  ///< outward unit vectors at rest, P
  std::vector<double> area;  ///< [m2] > 0, P
  /// Of the body under each point, to a depth of one cell, against pressure on the area [N/m] > 0,
  /// P.
  std::vector<double> stiffness;

  bool empty() const { return area.empty(); }
  std::uint32_t count() const { return static_cast<std::uint32_t>(area.size()); }
};

/// The node with the largest weight of a point; the first of equal ones.
std::uint32_t main_node(const Binding& binding, std::uint32_t point);

/// Throws InputError with the first point that breaks a rule stated above.
void validate(const ContactSurface& surface, std::uint32_t node_count);

}  // namespace springlod::inline model
