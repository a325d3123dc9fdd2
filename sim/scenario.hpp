#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "model/mass_spring.hpp"
#include "model/vec.hpp"

namespace springlod::sim {

/// Half-space obstacle: solid where normal . x < offset.
struct Plane {
  Vec3 normal = Vec3::UnitZ();  ///< unit length, out of the obstacle
  double offset = 0;            ///< [m]
};
/// Solid box, may be rotated.
struct SolidBox {
  Vec3 center = Vec3::Zero();        ///< [m]
  Vec3 half_size = Vec3::Ones();     ///< [m] > 0
  Mat3 rotation = Mat3::Identity();  ///< box axes as columns
  /// Coordinates of the point in the box axes, from the centre of the box [m].
  Vec3 local(const Vec3& point) const { return rotation.transpose() * (point - center); }
};

/// A fixed obstacle. A node of contact area A at depth d gets the penalty force kappa A d. Coulomb
/// friction is limited so that a step never reverses the slip. Contacts do not bound the time step.
struct Obstacle {
  std::variant<Plane, SolidBox> shape;
  std::string name;  ///< "floor", "wall": for labels and measurements
  /// kappa [N/m3] > 0; none: from the stiffness of the body under each point, see ContactPoints.
  std::optional<double> stiffness = std::nullopt;
  double friction = 0.5;  ///< mu >= 0
  double damping =
      0;  ///< contact damping time [s] >= 0: force kappa A (d + damping * rate of d), never pulling
};

/// Initial placement and velocity of a body: rotated about its centre of mass, then translated.
struct Throw {
  Mat3 rotation = Mat3::Identity();
  Vec3 position = Vec3::Zero();  ///< position of the centre of mass [m], if `placed`
  bool placed = false;           ///< false: the body stays at the position in the model
  Vec3 velocity = Vec3::Zero();  ///< [m/s]
  Vec3 spin = Vec3::Zero();      ///< angular velocity [rad/s]
};

/// When a run ends before its duration: the speed of the centre of mass stays below `speed` for
/// `hold` seconds.
struct StopRule {
  double speed = 0.1;  ///< [m/s]
  double hold = 0.25;  ///< [s]
};

struct Scenario {
  std::string name = "scenario";
  Vec3 gravity{0, 0, -9.81};  ///< [m/s2]
  std::vector<Obstacle> obstacles;
  Throw start;
  double duration = 1;  ///< [s] > 0
  std::optional<StopRule> stop;
  /// Distance measured at the end: from this obstacle's surface to the centre of mass; empty: the
  /// displacement of the centre of mass in the horizontal plane from the start.
  std::string measure_from;
};

/// Throws InputError naming the field.
void validate(const Scenario& scenario);

State initial_state(const MassSpringModel& model, const Throw& start);

/// Signed distance of a point from the obstacle's surface (negative inside) and the outward normal.
struct SurfaceDistance {
  double distance = 0;
  Vec3 normal = Vec3::UnitZ();
};
SurfaceDistance surface_distance(const Obstacle& obstacle, const Vec3& point);

}  // namespace springlod::sim
