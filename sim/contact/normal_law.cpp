#include "sim/contact/normal_law.hpp"

#include <algorithm>
#include <cmath>

namespace springlod::sim {
namespace {

/// The larger root of a z^2 + b z + c = 0 for a > 0 and c <= 0, without cancellation.
double positive_root(double a, double b, double c) {
  const double root = std::sqrt(std::max(0.0, b * b - 4 * a * c));
  return b > 0 ? -2 * c / (b + root) : (root - b) / (2 * a);
}

}  // namespace

double penalty_energy(double stiffness, double depth) {
  return depth > 0 ? 0.5 * stiffness * depth * depth : 0;
}

// With e = free, a = mobility, the depth at the end is e - a force(start, end): one quadratic
// equation for each of three cases. The force does not decrease with the end depth, so the solution
// is unique.
NormalLaw::Result NormalLaw::solve(double start, double free) const {
  const double stiff = mobility * stiffness;  // [1]
  const double late = stiff * damping;        // [1]
  const Result none{0, free};
  if (start <= 0) {
    if (free <= 0) return none;
    // comes in: (e - d)(d - start) = stiff d^2 / 2 + late d (d - start)
    const double depth =
        positive_root(1 + stiff / 2 + late, -(start * (1 + late) + free), free * start);
    return {(free - depth) / mobility, depth};
  }
  // stays inside: e - d = stiff (start + d) / 2 + late (d - start)
  const double inside = (free - (stiff / 2 - late) * start) / (1 + stiff / 2 + late);
  if (inside > 0) return free > inside ? Result{(free - inside) / mobility, inside} : none;
  // leaves: (e + late start - d)(start - d) = stiff start^2 / 2, and d = start - p with p > 0
  const double gap = free + late * start - start;
  const double p = positive_root(1, gap, -stiff / 2 * start * start);
  const double depth = start - p;
  return free > depth ? Result{(free - depth) / mobility, depth} : none;
}

}  // namespace springlod::sim
