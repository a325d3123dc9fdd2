#pragma once

#include "lod/build.hpp"
#include "model/chain.hpp"
#include "sim/scenario.hpp"
#include "tests/support/bodies.hpp"

/// The two scenes of docs/paper.md, and smaller ones.
namespace springlod::test {

/// Neither gravity nor obstacles.
inline sim::Scenario weightless(double duration) {
  sim::Scenario scene;
  scene.gravity = Vec3::Zero();
  scene.duration = duration;
  return scene;
}

inline sim::Obstacle floor(double kappa, double friction) {
  sim::Obstacle obstacle;
  obstacle.shape = sim::Plane{Vec3::UnitZ(), 0};
  obstacle.name = "floor";
  obstacle.stiffness = kappa;
  obstacle.friction = friction;
  return obstacle;
}

/// A small block and two levels of it.
inline const LodChain& small_chain() {
  static const LodChain chain = lod::simplify(
      block(5, 4, 3, 0.1, material("m", 1e6, 1000, 0.002), voxelize::LatticeStyle::centers), {});
  return chain;
}

/// For small_chain: thrown onto the floor with a spin.
inline sim::Scenario small_scene(double duration) {
  sim::Scenario scene;
  scene.obstacles = {floor(1e6, 0.5)};
  scene.start.placed = true;
  scene.start.position = {0, 0, 0.5};
  scene.start.velocity = {2, 0, 0};
  scene.start.spin = {0, 3, 1};
  scene.duration = duration;
  return scene;
}

/// Scene 1: the ball thrown along a floor.
inline sim::Scenario ball_scene() {
  sim::Scenario scene;
  scene.obstacles = {floor(1e6, 0.5)};
  scene.start.placed = true;
  scene.start.position = {0, 0, 0.6};
  scene.start.velocity = {3.2, 0, 0};
  scene.stop = sim::StopRule{0.1, 0.25};
  scene.duration = 12;
  return scene;
}

/// Scene 2: the rods thrown at a wall with a spin.
inline sim::Scenario rods_scene() {
  sim::Scenario scene;
  sim::Obstacle wall = floor(2e6, 0.5);
  wall.shape = sim::Plane{-Vec3::UnitX(), -2};
  wall.name = "wall";
  scene.obstacles = {floor(2e6, 0.5), wall};
  scene.start.placed = true;
  scene.start.position = {0, 0, 2};
  scene.start.velocity = {10, 0, 0};
  scene.start.spin = {0, 6, 0};
  scene.duration = 5;
  scene.measure_from = "wall";
  return scene;
}

}  // namespace springlod::test
