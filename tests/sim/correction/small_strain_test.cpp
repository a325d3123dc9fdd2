// Corners that never come near inversion do not change a bit of a run.

#include <algorithm>

#include <catch2/catch.hpp>

#include "tests/sim/correction/throws.hpp"
#include "tests/support/bodies.hpp"
#include "voxelize/random/random.hpp"

using namespace springlod;
using namespace springlod::sim;

namespace {

MassSpringModel random_body() {
  voxelize::MaterialGrid grid;
  grid.cell = 0.1;
  grid.materials = {test::material("m", 1e6, 1000, 0.002)};
  for (int z = 0; z < 3; ++z)
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 5; ++x) grid.cells.push_back({x, y, z});
  grid.material.assign(grid.cells.size(), 0);
  return voxelize::build_random(grid, {.nodes = 80, .rescale = false}).model;
}

MassSpringModel corners_lattice() {
  return test::block(5, 4, 3, 0.1, test::material("m", 1e6, 1000, 0.002),
                     voxelize::LatticeStyle::corners);
}

bool same_bits(const Trajectory& p, const Trajectory& q) {
  bool same = p.steps == q.steps && p.step == q.step && p.shortest_step == q.shortest_step &&
              p.final.x == q.final.x && p.final.v == q.final.v &&
              p.frames.size() == q.frames.size() && p.ledger.size() == q.ledger.size();
  for (std::size_t i = 0; same && i < p.frames.size(); ++i) same = p.frames[i].x == q.frames[i].x;
  for (std::size_t i = 0; same && i < p.ledger.size(); ++i)
    same = p.ledger[i].total() == q.ledger[i].total() && p.ledger[i].lost_corners == 0;
  return same;
}

}  // namespace

TEST_CASE("Where no corner comes near inversion, corners do not change a bit of a run") {
  const auto& [name, model] = GENERATE(
      table<std::string, MassSpringModel>({{"corners", corners_lattice()},
                                           {"centers", test::small_chain().levels[0].model},
                                           {"merged", test::small_chain().levels[1].model},
                                           {"merged twice", test::small_chain().levels[2].model},
                                           {"random", random_body()}}));
  REQUIRE(model.corner_count() > 0);
  Scenario scene = test::small_scene(0.5);
  RunOptions options{.frame_rate = 500};
  for (const Integrator integrator :
       {Integrator::symplectic_euler, Integrator::velocity_verlet, Integrator::runge_kutta_4})
    for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
      if (precision == Precision::single_precision && integrator != Integrator::symplectic_euler)
        continue;
      CAPTURE(name, to_string(integrator), to_string(precision));
      options.integrator = integrator;
      options.precision = precision;
      options.volumes = true;
      const Trajectory resists = run(model, scene, options);
      double least = 1;
      for (const Frame& frame : resists.frames)
        least = std::min(least, test::least_ratio(model, frame.x));
      REQUIRE(least > kCornerResists);
      REQUIRE(least < 0.99);  // it is deformed
      REQUIRE(resists.first_contact.has_value());
      options.volumes = false;
      CHECK(same_bits(resists, run(model, scene, options)));
      CHECK(same_bits(resists, run(test::without_corners(model), scene, options)));
    }
}
