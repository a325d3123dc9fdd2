#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/correction/step_nodes.hpp"
#include "sim/fast/look/corner_look.hpp"
#include "sim/fast/moving_frame.hpp"
#include "sim/fast/rigid_motion.hpp"

namespace springlod::sim {

struct NodeMotion {
  Vec3 x = Vec3::Zero();  ///< [m]
  Vec3 v = Vec3::Zero();  ///< [m/s]
};

/// Positions and velocities of one body in a fast layout, relative to a frame that the owner keeps.
/// The body is moved block by block. Several threads may work on different blocks; the assignment
/// of blocks to threads does not change the result.
///
/// A step: every block finds its forces. When all blocks in needs() have done so, a block collects
/// their forces and moves. Then its nodes may be shifted.
class FastBody {
 public:
  struct BlockRange {
    std::uint32_t first = 0;
    std::uint32_t last = 0;  ///< inclusive
  };

  virtual ~FastBody() = default;
  FastBody(const FastBody&) = delete;
  FastBody& operator=(const FastBody&) = delete;

  virtual std::uint32_t block_count() const = 0;
  /// Blocks whose forces must be found before this one may move.
  virtual BlockRange needs(std::uint32_t block) const = 0;
  /// Node numbers in the model, by index in the block.
  virtual std::span<const std::uint32_t> nodes(std::uint32_t block) const = 0;

  // Copy the nodes of the block from or to vectors of all N nodes, in world axes.
  virtual void set(std::uint32_t block, const MovingFrame& frame, const std::vector<Vec3>& x,
                   const std::vector<Vec3>& v) = 0;
  virtual void get_x(std::uint32_t block, const MovingFrame& frame, std::vector<Vec3>& x) const = 0;
  virtual void get_v(std::uint32_t block, const MovingFrame& frame, std::vector<Vec3>& v) const = 0;

  /// Computes the spring forces of a block.
  virtual void find_forces(std::uint32_t block) = 0;
  /// Adds the forces that other blocks computed on this block's nodes.
  virtual void collect_forces(std::uint32_t block) = 0;
  /// Sum of damping force times velocity over the block's nodes [W], after collect_forces(). Only
  /// for a body made with damping.
  virtual double damping_power(std::uint32_t block) const = 0;
  /// v += kick f / m, then x += drift v, for the nodes of the block [s]. A kick or drift of 0 skips
  /// that part.
  virtual void move(std::uint32_t block, double kick, double drift) = 0;
  /// Bounding box of the block's nodes after its last move [m].
  virtual const Box3& bounds(std::uint32_t block) const = 0;
  /// Largest displacement of the block's nodes in its last move, along each axis [m].
  virtual const Vec3& largest_displacement(std::uint32_t block) const = 0;

  /// The rigid motion that largest_departure() leaves out; at first none. It does not change the
  /// motion of the body. Set it while no block moves.
  virtual void set_rigid_motion(const RigidMotion& motion) = 0;
  virtual const RigidMotion& rigid_motion() const = 0;
  /// Whether largest_departure() counts the nodes; at first all. Set it while no block moves.
  virtual void count_departures(std::span<const std::uint32_t> nodes, bool counts) = 0;
  /// Largest displacement of the block's nodes that count, in its last drift, relative to the rigid
  /// motion, along each axis [m]: the maximum of |drift (v - velocity - spin x x)| with x at the
  /// end of the drift.
  virtual const Vec3& largest_departure(std::uint32_t block) const = 0;

  // The state of the material. Call them when all blocks have moved and their nodes have been
  // shifted; different blocks may be looked at in parallel.

  /// Looks at the groups of corners of the block that are due. Appends the numbers in the model of
  /// their corners that have no margin: that resist, but for a bound on the error of rounding, or
  /// whose volume is not a number. Returns the travel at which the next group of the block is due
  /// [m], infinity without corners. A corner belongs to the block of its node[0].
  ///
  /// The travel of the body is the sum, over all steps so far, of the largest displacement of a
  /// node relative to a rigid motion; it must not fall. A group is due as soon as the body has
  /// travelled by the least corner_margin() of its corners since it was looked at: at once if one
  /// of them has none, and at the first look at a body. So all corners that resist are found.
  virtual double find_corners(std::uint32_t block, const CornerLook& look,
                              std::vector<std::uint32_t>& found) = 0;
  /// Largest |l - L| / L of the springs that the block computes [1]; not a number if a length is
  /// not. 0 without springs.
  virtual double largest_strain(std::uint32_t block) const = 0;

  /// Largest absolute value of a coordinate in the bounds of all blocks [m].
  double farthest_coordinate() const;

  // Single nodes of any blocks, many in one call.

  /// Copies their motions in world axes.
  virtual void get_motions(std::span<const std::uint32_t> nodes, const MovingFrame& frame,
                           std::span<NodeMotion> motions) const = 0;
  /// Copies their forces without the damping part [N], after collect_forces(). Only for a body made
  /// with damping.
  virtual void get_elastic_forces(std::span<const std::uint32_t> nodes,
                                  std::span<Vec3> forces) const = 0;
  /// Changes their motions; the bounds of their blocks then include them.
  virtual void shift(std::span<const NodeChange> changes) = 0;

 protected:
  FastBody() = default;
};

inline double FastBody::farthest_coordinate() const {
  double farthest = 0;
  for (std::uint32_t b = 0; b < block_count(); ++b) {
    const Box3& box = bounds(b);
    farthest = std::max(farthest, box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff());
  }
  return farthest;
}

}  // namespace springlod::sim
