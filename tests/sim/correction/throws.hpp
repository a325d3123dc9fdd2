#pragma once

#include <memory>
#include <vector>

#include "lod/build.hpp"
#include "sim/contact/contact_skin.hpp"
#include "sim/run.hpp"
#include "tests/sim/scenes.hpp"

/// Throws that press soft bodies together until their corners resist.
namespace springlod::test {

/// 5 x 5 x 10 cells of 2 cm, 0.2 MPa and 1000 kg/m3: its wave speed is 14 m/s. With two levels.
inline LodChain soft_bar(double damping) {
  return lod::simplify(
      block(5, 5, 10, 0.02, material("m", 2e5, 1000, damping), voxelize::LatticeStyle::corners),
      {.levels = 2});
}

/// The bar, 1 cm above an automatic floor, falls on its end [m/s].
inline sim::Scenario bar_throw(double speed) {
  sim::Scenario scene;
  scene.obstacles = {floor(1, 0.5)};
  scene.obstacles[0].stiffness.reset();
  scene.start.placed = true;
  scene.start.position = {0, 0, 0.11};
  scene.start.velocity = {0, 0, -speed};
  scene.duration = 0.1;
  return scene;
}

/// Of the level, at its nodes or at the surface of the base.
inline std::shared_ptr<const sim::ContactSkin> contacts_at(const LodChain& chain,
                                                           std::uint32_t level, bool at_surface) {
  if (!at_surface) return nullptr;
  return std::make_shared<const sim::ContactSkin>(sim::contact_skin(chain, level));
}

inline MassSpringModel without_corners(MassSpringModel model) {
  model.corners.clear();
  return model;
}

/// Least J of a corner [1].
inline double least_ratio(const MassSpringModel& model, const std::vector<Vec3>& x) {
  double least = 1;
  for (const Corner& corner : model.corners)
    least = std::min(least, corner_volume(corner, x) / corner_volume(corner, model.rest));
  return least;
}

}  // namespace springlod::test
