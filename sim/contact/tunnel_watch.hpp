#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/contact/contact_points.hpp"
#include "sim/scenario.hpp"

namespace springlod::sim {

/// Detects tunnelling: follows the points of a body through the boxes of a scenario, step by step,
/// for any scheme. A point has tunnelled if it leaves a box by the face opposite to the one by
/// which it entered, in one step or in many. (Cutting a corner, in by one face and out by a
/// neighbouring one, happens at any step length and is allowed.) A step costs one transformation
/// per box and point, and nothing without boxes.
class TunnelCheck {
 public:
  /// `x`: the start positions of the nodes. The points must outlive the watch.
  TunnelCheck(const ContactPoints& points, const std::vector<Obstacle>& obstacles,
              const std::vector<Vec3>& x);
  /// Checks the next step, at whose end the nodes are at `x`. Throws TunnelError for the first
  /// point that tunnelled.
  void check(const std::vector<Vec3>& x, double time, double step);

  /// The same for one box and one point that moved from one position to another. Returns true if it
  /// tunnelled. Points that stay outside may be skipped.
  bool goes_through(std::size_t wall, std::size_t point, const Vec3& from, const Vec3& to);
  [[noreturn]] void throw_tunnelled(std::size_t wall, std::size_t point, const Vec3& from,
                                    const Vec3& to, double time, double step) const;
  std::size_t wall_count() const { return walls_.size(); }
  const SolidBox& wall(std::size_t number) const { return walls_[number].box; }

 private:
  /// A face of a box: 1 to 3 for those at the positive end of its axes, -1 to -3 for the others.
  using Face = std::int8_t;

  struct Wall {
    std::string name;
    SolidBox box;
    std::vector<Face> entry;  // face by which each point entered; 0 outside
  };
  struct Pass {
    Face in = 0;   // 0: it was inside before
    Face out = 0;  // 0: it is inside now
    bool hits = false;
  };
  static Pass pass(const Vec3& half_size, const Vec3& from, const Vec3& to);

  const ContactPoints* points_;
  std::vector<Vec3> at_;  // positions [m]; empty without walls
  std::vector<Wall> walls_;
};

}  // namespace springlod::sim
