#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/fast/moving_frame.hpp"
#include "sim/fast/place.hpp"

namespace springlod::sim {

/// Positions and velocities of one body in a fast memory layout, relative to a moving frame that
/// the owner stores. The body is advanced block by block. Several threads may process the blocks;
/// the assignment of blocks to threads changes no bit of the result.
///
/// In a step, every block computes its forces. A block moves as soon as all blocks that it `needs`
/// have computed theirs; before, it collects their forces on its nodes. Between collecting and
/// moving, external forces may be added to its nodes.
class FastBody {
 public:
  struct BlockRange {
    std::uint32_t first = 0;
    std::uint32_t last = 0;  ///< included
  };

  virtual ~FastBody() = default;
  FastBody(const FastBody&) = delete;
  FastBody& operator=(const FastBody&) = delete;

  virtual std::uint32_t block_count() const = 0;
  /// Blocks whose forces must be computed before this one may move.
  virtual BlockRange needs(std::uint32_t block) const = 0;
  virtual Place place(std::uint32_t node) const = 0;
  /// Nodes of the block, by index.
  virtual std::span<const std::uint32_t> nodes(std::uint32_t block) const = 0;

  // Writes the nodes of the block into vectors of all N nodes of the model, in world axes.
  virtual void set(std::uint32_t block, const MovingFrame& frame, const std::vector<Vec3>& x,
                   const std::vector<Vec3>& v) = 0;
  virtual void get_x(std::uint32_t block, const MovingFrame& frame, std::vector<Vec3>& x) const = 0;
  virtual void get_v(std::uint32_t block, const MovingFrame& frame, std::vector<Vec3>& v) const = 0;

  /// Evaluates the springs of a block.
  virtual void find_forces(std::uint32_t block) = 0;
  /// Adds the forces that other blocks computed for the nodes of this one.
  virtual void collect_forces(std::uint32_t block) = 0;
  /// Sum of damping force times velocity over the block's nodes [W], after collecting; only for a
  /// body built with damping.
  virtual double damping_power(std::uint32_t block) const = 0;
  /// v += kick f / m, then x += drift v, for the nodes of the block; kick and drift in [s]; 0 skips
  /// that part.
  virtual void move(std::uint32_t block, double kick, double drift) = 0;
  /// Bounding box of the block's nodes after its last move [m].
  virtual const Box3& bounds(std::uint32_t block) const = 0;

  /// Appends the indices of the block's nodes within `region` [m], ascending.
  virtual void nodes_in(std::uint32_t block, const Box3& region,
                        std::vector<std::uint32_t>& indices) const = 0;

  virtual Vec3 x(Place at) const = 0;                       ///< [m]
  virtual Vec3 v(Place at) const = 0;                       ///< [m/s]
  virtual Vec3 force(Place at) const = 0;                   ///< [N], once collected
  virtual void add_force(Place at, const Vec3& force) = 0;  ///< [N]; before its block moves

 protected:
  FastBody() = default;
};

}  // namespace springlod::sim
