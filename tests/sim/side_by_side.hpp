#pragma once

#include <algorithm>
#include <optional>
#include <type_traits>
#include <vector>

#include <catch2/catch.hpp>

#include "sim/fast/fast_leapfrog.hpp"
#include "sim/integrators/step_limit.hpp"
#include "sim/integrators/stepper.hpp"
#include "tests/sim/scenes.hpp"
#include "voxelize/lattice/lattice.hpp"

/// Compares steppers in a scene with all kinds of contact.
namespace springlod::test {

/// A block of cells of two materials with a notch, with these Poisson's ratios.
inline MassSpringModel two_material_block(int side, double soft_poisson = kSpringPoisson,
                                          double hard_poisson = kSpringPoisson) {
  voxelize::MaterialGrid grid;
  grid.cell = 0.01;
  grid.materials = {Material{.name = "soft", .young = 1e5, .damping = 0.002},
                    Material{.name = "hard", .young = 8e5, .damping = 0.001}};
  grid.materials[0].poisson = soft_poisson;
  grid.materials[1].poisson = hard_poisson;
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side + 1; ++y)
      for (int x = 0; x < side + 3; ++x) {
        if (x < 2 && y < 2) continue;
        grid.cells.push_back({x, y, z});
        grid.material.push_back(x > side / 2 ? 1 : 0);
      }
  return voxelize::build_lattice(grid).model;
}

/// The body spins, falls onto a floor and slides into a rotated box.
inline sim::Scenario rough_scene(const MassSpringModel& model) {
  sim::Scenario scene;
  sim::Obstacle ground = floor(2e6, 0.4);
  ground.damping = 1e-4;
  sim::Obstacle block;
  block.name = "block";
  block.stiffness = 2e6;
  block.friction = 0.3;
  const Box3 box = bounds(model.rest);
  std::get<sim::Plane>(ground.shape).offset = box.min().z() - 1e-4;
  block.shape = sim::SolidBox{.center = box.center() + Vec3(0.55 * box.sizes().x() + 0.02, 0, 0),
                              .half_size = {0.02, 0.2, 0.2},
                              .rotation = Eigen::AngleAxisd(0.1, Vec3::UnitZ()).toRotationMatrix()};
  scene.obstacles = {ground, block};
  scene.start.velocity = {1.5, 0.2, -0.5};
  scene.start.spin = {1, 3, -2};
  return scene;
}

struct Outcome {
  State state;
  sim::LedgerEntry ledger;
  std::size_t contacts = 0;
  std::optional<double> first_contact;
};

/// The options of a stepper of this type.
template <class Scheme>
using OptionsOf = std::conditional_t<std::is_same_v<Scheme, sim::FastLeapfrog>, sim::FastOptions,
                                     sim::StepperOptions>;

template <class Scheme>
Outcome after(const MassSpringModel& model, const sim::Scenario& scene, std::uint64_t steps,
              const OptionsOf<Scheme>& options, std::uint64_t stride) {
  const double step = 0.5 * sim::predicted_step(model);
  Scheme body(model, scene, sim::initial_state(model, scene.start), step, options);
  body.prepare();
  while (body.step_number() < steps) body.advance(std::min(stride, steps - body.step_number()));
  return {body.state(), body.ledger_entry(), body.contacts().size(), body.first_contact()};
}

inline double largest_difference(const std::vector<Vec3>& p, const std::vector<Vec3>& q) {
  double most = 0;
  for (std::size_t i = 0; i < p.size(); ++i) most = std::max(most, (p[i] - q[i]).norm());
  return most;
}

inline void check_same_bits(const Outcome& p, const Outcome& q) {
  CHECK(p.state.x == q.state.x);
  CHECK(p.state.v == q.state.v);
  CHECK(p.ledger.total() == q.ledger.total());
  CHECK(p.contacts == q.contacts);
  CHECK(p.first_contact == q.first_contact);
}

}  // namespace springlod::test
