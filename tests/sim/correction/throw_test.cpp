// Hard throws of soft bodies: no corner stays inside out, energy, and the length of the step.

#include <algorithm>

#include <catch2/catch.hpp>

#include "sim/integrators/step_limit.hpp"
#include "tests/sim/correction/throws.hpp"

using namespace springlod;
using namespace springlod::sim;

namespace {

struct Scheme {
  Integrator integrator = Integrator::symplectic_euler;
  Precision precision = Precision::double_precision;
  Layout layout = Layout::fastest;
  double safety = 0.8;
};

/// Only symplectic Euler shortens its step in a strained body; Runge-Kutta gains energy there with
/// the step for the body at rest.
const std::vector<Scheme>& schemes() {
  static const std::vector<Scheme> all{
      {},
      {.precision = Precision::single_precision},
      {.layout = Layout::any_shape},
      {.integrator = Integrator::velocity_verlet},
      {.integrator = Integrator::runge_kutta_4, .safety = 0.2},
  };
  return all;
}

const LodChain& bar() {
  static const LodChain chain = test::soft_bar(1e-3);
  return chain;
}

/// Of 5 x 5 x 5 cells of 4 cm and 0.1 MPa: its wave speed is 10 m/s.
const LodChain& cube() {
  static const LodChain chain =
      lod::simplify(test::block(5, 5, 5, 0.04, test::material("m", 1e5, 1000, 2e-3),
                                voxelize::LatticeStyle::corners),
                    {.levels = 2});
  return chain;
}

/// The cube falls from 2 m, on a face or on a corner.
Scenario drop(bool tilted) {
  Scenario scene = test::bar_throw(0);
  scene.start.position = {0, 0, 2};
  if (tilted)
    scene.start.rotation = Eigen::AngleAxisd(0.9, Vec3(1, 2, 0.3).normalized()).toRotationMatrix();
  scene.duration = 0.9;
  return scene;
}

RunOptions options_of(const Scheme& scheme, const LodChain& chain, std::uint32_t level,
                      bool at_surface) {
  return {.integrator = scheme.integrator,
          .safety = scheme.safety,
          .frame_rate = 500,
          .precision = scheme.precision,
          .layout = scheme.layout,
          .skin = test::contacts_at(chain, level, at_surface)};
}

/// Calls check(trajectory, model) for all schemes, levels and kinds of contact.
template <class Check>
void for_all_runs(const LodChain& chain, const Scenario& scene, bool volumes, const Check& check) {
  for (const Scheme& scheme : schemes())
    for (const std::uint32_t level : {0U, 1U, 2U})
      for (const bool at_surface : {false, true}) {
        if (level == 0 && at_surface) continue;  // the same
        CAPTURE(to_string(scheme.integrator), to_string(scheme.precision), to_string(scheme.layout),
                level, at_surface);
        RunOptions options = options_of(scheme, chain, level, at_surface);
        options.volumes = volumes;
        const MassSpringModel& model = chain.levels[level].model;
        check(run(model, scene, options), model);
      }
}

double largest_kinetic(const Trajectory& t) {
  double most = 0;
  for (const LedgerEntry& entry : t.ledger) most = std::max(most, entry.kinetic);
  return most;
}

/// What holds in a throw with volumes.
void check_throw(const Trajectory& t, const MassSpringModel& model) {
  CHECK(t.inverted_at_end == 0);
  CHECK(inverted_corners(model.corners, t.final.x).empty());
  CHECK(test::least_ratio(model, t.final.x) > 0.1);
  CHECK(t.first_contact.has_value());
  CHECK(closure_error(t.ledger) < 0.01);
  CHECK(t.shortest_step >= 0.5 * t.step);
  const double lost = t.ledger.back().lost_corners;
  CHECK(lost >= 0);
  CHECK(lost < 0.3 * largest_kinetic(t));
  // Corners are seen to resist in frames only, and lose nothing elsewhere.
  bool resisted = false;
  for (const Frame& frame : t.frames)
    resisted = resisted || test::least_ratio(model, frame.x) < kCornerResists;
  if (resisted) CHECK(lost > 0);
}

}  // namespace

TEST_CASE("No corner of a soft bar is inside out after a hard impact, the ledger closes") {
  const double speed = GENERATE(4.0, 8.0, 12.0);
  CAPTURE(speed);
  for_all_runs(bar(), test::bar_throw(speed), true,
               [&](const Trajectory& t, const MassSpringModel& model) {
                 check_throw(t, model);
                 if (speed > 5) CHECK(t.ledger.back().lost_corners > 0);
               });
}

TEST_CASE("No corner of a soft cube is inside out after a fall from 2 m, the ledger closes") {
  const bool tilted = GENERATE(false, true);
  CAPTURE(tilted);
  for_all_runs(cube(), drop(tilted), true, check_throw);
}

TEST_CASE("Without volumes, bodies turn inside out, which is reported with time and place") {
  const double speed = 12;
  for_all_runs(bar(), test::bar_throw(speed), false,
               [&](const Trajectory& t, const MassSpringModel& model) {
                 const std::size_t inverted = inverted_corners(model.corners, t.final.x).size();
                 CHECK(t.inverted_at_end == inverted);
                 CHECK(inverted > model.corner_count() / 4);
                 CHECK(t.inversions.most >= inverted);
                 CHECK(t.ledger.back().lost_corners == 0);
                 REQUIRE(t.inversions.first.has_value());
                 const Inversion& first = *t.inversions.first;
                 CHECK(first.corner < model.corner_count());
                 // Within the time in which the bar would have moved by half its length.
                 CHECK(first.time >= *t.first_contact);
                 CHECK(first.time < 0.01 / speed + 0.1 / speed);
                 CHECK(std::abs(first.place.z()) < 0.04);
                 CHECK(first.place.head<2>().norm() < 0.12);
                 CHECK_FALSE(t.first_crossing.has_value());
               });
}

TEST_CASE("Corners that do not resist lose nothing, and volumes do not change the step at rest") {
  for_all_runs(bar(), test::bar_throw(0.5), true,
               [&](const Trajectory& t, const MassSpringModel& model) {
                 CHECK(t.ledger.back().lost_corners == 0);
                 CHECK_FALSE(t.inversions.first.has_value());
                 CHECK(t.inversions.most == 0);
                 CHECK(t.shortest_step == t.step);
                 CHECK(test::least_ratio(model, t.final.x) > kCornerResists);
               });
  for (const Scheme& scheme : schemes()) {
    RunOptions options = options_of(scheme, bar(), 1, false);
    const MassSpringModel& model = bar().levels[1].model;
    const Trajectory with = run(model, test::bar_throw(8), options);
    options.volumes = false;
    CHECK(run(model, test::bar_throw(8), options).step == with.step);
    CHECK(run(test::without_corners(model), test::bar_throw(8), options).step == with.step);
  }
}

TEST_CASE("The ledger of a run that starts with a flattened body closes") {
  const MassSpringModel& model = bar().levels[0].model;
  State start = rest_state(model);
  for (Vec3& x : start.x) x.z() *= 0.2;
  REQUIRE(test::least_ratio(model, start.x) < kCornerResists);
  Scenario scene = test::weightless(0.05);
  for (const Scheme& scheme : schemes()) {
    CAPTURE(to_string(scheme.integrator), to_string(scheme.precision), to_string(scheme.layout));
    RunOptions options = options_of(scheme, bar(), 0, false);
    options.safety = std::min(options.safety, 0.4);
    const Trajectory t = run(model, scene, start, options);
    CHECK(closure_error(t.ledger) < 0.01);
    CHECK(t.ledger.back().lost_corners > 0);
    CHECK(t.inverted_at_end == 0);
  }
}

TEST_CASE("Frames do not change a run whose step is adapted") {
  const double speed = GENERATE(8.0, 12.0);
  const std::uint32_t level = GENERATE(0U, 1U);
  const MassSpringModel& model = bar().levels[level].model;
  for (const Layout layout : {Layout::fastest, Layout::any_shape}) {
    CAPTURE(speed, level, to_string(layout));
    RunOptions options{.frame_rate = 0, .layout = layout};
    const Trajectory none = run(model, test::bar_throw(speed), options);
    REQUIRE(none.shortest_step < none.step);
    for (const double per_step : {0.1, 1.0, 2.0}) {
      options.frame_rate = per_step / none.step;
      const Trajectory many = run(model, test::bar_throw(speed), options);
      CHECK(many.steps == none.steps);
      CHECK(many.shortest_step == none.shortest_step);
      CHECK((many.final.x == none.final.x));
      CHECK((many.final.v == none.final.v));
    }
  }
}

TEST_CASE("Verlet and Runge-Kutta close the ledger at the default step and name their own error") {
  const MassSpringModel& model = bar().levels[0].model;
  const Integrator integrator = GENERATE(Integrator::velocity_verlet, Integrator::runge_kutta_4);
  // Fraction of the kinetic energy that the scheme takes or gives.
  const auto lost_scheme = [&](double safety) {
    CAPTURE(to_string(integrator), safety);
    const Trajectory t = run(model, test::bar_throw(12),
                             {.integrator = integrator, .safety = safety, .frame_rate = 500});
    CHECK(closure_error(t.ledger) < 1e-9);
    // If the part of the scheme were the remainder of all others, the sum would also close here.
    for (const auto part : {&LedgerEntry::lost_contact, &LedgerEntry::lost_corners}) {
      auto without = t.ledger;
      for (LedgerEntry& entry : without) entry.*part = 0;
      CHECK(closure_error(without) > 1e-4);
    }
    return std::abs(t.ledger.back().lost_scheme) / largest_kinetic(t);
  };
  const double usual = lost_scheme(0.8);
  CHECK(usual > 5e-4);
  CHECK(lost_scheme(0.2) < 0.2 * usual);
}
