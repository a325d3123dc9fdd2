#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/scenario.hpp"

namespace springlod {

/// Follows the nodes with an area through the boxes of a scenario, step by step, whatever the
/// scheme: a node that leaves a box by the face opposite to the one by which it came in, in one
/// step or in many, has gone through. (Cutting a corner, in by one face and out by one beside it,
/// happens at any step and is let pass.) A step costs one turn into the axes of each box a node;
/// nothing without boxes.
class TunnelWatch {
 public:
  /// `x`: the start positions.
  TunnelWatch(const MassSpringModel& model, const std::vector<Obstacle>& obstacles,
              const std::vector<Vec3>& x);
  /// Positions at the end of the next step. Throws TunnelError for the first node that went
  /// through.
  void look(const std::vector<Vec3>& x, double time, double step);

 private:
  /// A face of a box: 1 to 3 for those at the positive end of its axes, -1 to -3 for the others.
  using Face = std::int8_t;

  struct Wall {
    std::string name;
    SolidBox box;
    std::vector<Vec3> at;     // where the nodes are, in the axes of the box [m]
    std::vector<Face> entry;  // by which face they came in; 0 outside
  };
  struct Pass {
    Face in = 0;   // 0: was inside before
    Face out = 0;  // 0: is inside now
    bool hits = false;
  };
  static Pass pass(const Vec3& half_size, const Vec3& from, const Vec3& to);
  [[noreturn]] static void throw_tunnelled(const Wall& wall, std::uint32_t node, Face out,
                                           const Vec3& way, double time, double step);

  std::vector<std::uint32_t> node_;  // nodes with an area
  std::vector<Wall> walls_;
};

}  // namespace springlod
