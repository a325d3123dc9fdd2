#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "sim/fast/fast_correction.hpp"
#include "sim/integrators/stepper.hpp"

namespace springlod::sim {

/// Looks at a fast body as often as its motion asks, and stops it where it must be checked. The
/// travel of a step, the largest displacement of a node relative to a rigid motion, bounds how far
/// lengths and volumes can have changed since they were last looked at. Calls for each drift, when
/// all blocks have moved:
///
///   one thread, after the correction of contacts:  plan(step);
///   while (looks()):
///     for each block, by any thread:  look(block);
///     one thread:                     solve_corners();
///   one thread, after the correction:  finish(step);
///
/// solve_corners() is called at least once, and no thread reads looks() while one may change it.
class FastWatch {
 public:
  /// `shortest`: rest length of the shortest spring [m].
  FastWatch(const FastBody& body, std::uint32_t node_count, double shortest)
      : fit_(node_count), shortest_(shortest), strains_(body.block_count(), 0) {}

  void set(const Stepper::Watch& limits);

  /// Takes the rigid motion of the body as it is now. Call it when the body has a new frame.
  void follow(FastBody& body) const { body.set_rigid_motion(fit_.fit(body)); }

  void plan(const FastStep& step, FastCorrection& correction);
  bool looks() const { return at_corners_ || at_springs_; }
  void look(std::uint32_t block, const FastBody& body, FastCorrection& correction);
  void solve_corners(FastCorrection& correction);
  void finish(const FastStep& step, FastBody& body, const FastCorrection& correction);

  /// Whether a limit was exceeded in the last step.
  bool stopped() const { return stopped_; }

 private:
  /// Bound on the strain of the springs now [1].
  double largest_strain() const;

  RigidFit fit_;
  Stepper::Watch limits_;
  double shortest_;                               // [m]
  bool at_corners_ = false, at_springs_ = false;  // at what to look next
  bool saw_springs_ = false;                      // in this step
  bool stopped_ = false;
  // Travel since the springs were last looked at [m]; at the start they are not known.
  double travel_ = std::numeric_limits<double>::infinity();
  double strain_ = 0;            // largest, then [1]
  std::uint32_t steps_ = 0;      // since then
  std::vector<double> strains_;  // by block [1]
};

}  // namespace springlod::sim
