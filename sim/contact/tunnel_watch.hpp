#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/contact/contact_points.hpp"
#include "sim/scenario.hpp"

namespace springlod::sim {

/// Detects tunnelling of a body's points through the boxes of a scenario, with any integrator. A
/// point has passed through a box if it leaves by the face opposite to the one by which it entered,
/// in one step or in several. (Cutting a corner, in by one face and out by an adjacent one, happens
/// at any step size and is allowed.) Each step rotates every point into the axes of each box;
/// without boxes it costs nothing.
class TunnelCheck {
 public:
  /// `x`: the start positions of the nodes. The points must outlive the watch.
  TunnelCheck(const ContactPoints& points, const std::vector<Obstacle>& obstacles,
              const std::vector<Vec3>& x);
  /// Checks the next step, at whose end the nodes are at `x`. Throws TunnelError for the first
  /// point that passed through a box.
  void check(const std::vector<Vec3>& x, double time, double step);

  /// The same for one box and one point, given its previous and present position. Returns true if
  /// the point passed through. Points that stay outside may be skipped.
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
    std::vector<Face> entry;  // face by which they entered; 0 outside
  };
  struct Pass {
    Face in = 0;   // 0: was inside before
    Face out = 0;  // 0: is inside now
    bool hits = false;
  };
  static Pass pass(const Vec3& half_size, const Vec3& from, const Vec3& to);

  const ContactPoints* points_;
  std::vector<Vec3> at_;  // present positions [m]; empty without boxes
  std::vector<Wall> walls_;
};

}  // namespace springlod::sim
