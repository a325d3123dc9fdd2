// Inversions that a run reports, compared with a look at all corners after every step.

#include <algorithm>

#include <catch2/catch.hpp>

#include "sim/correction/inversion.hpp"
#include "sim/integrators/step_limit.hpp"
#include "sim/integrators/stepper.hpp"
#include "tests/sim/correction/throws.hpp"

using namespace springlod;
using namespace springlod::sim;

namespace {

/// A run with these options, step by step, without changes of the step.
struct StepByStepRun {
  StepByStepRun(const MassSpringModel& of_model, const Scenario& of_scene,
                const RunOptions& options, double step)
      : model(&of_model),
        scene(of_scene),
        plan(plan_runs(of_model, scene, options)),
        body(
            choice_of(options.integrator)
                .make(of_model, scene, initial_state(of_model, scene.start), step, options, plan)) {
    body->prepare();
  }
  bool advance() {
    if (body->time() >= scene.duration) return false;
    body->advance(1);
    return true;
  }
  std::vector<std::uint32_t> inverted() const {
    return inverted_corners(model->corners, body->positions());
  }

  const MassSpringModel* model;
  Scenario scene;
  RunPlan plan;
  std::unique_ptr<Stepper> body;
};

/// Compares what the run reports with a look at all corners after each step. Returns the largest
/// number of inverted corners.
std::uint32_t compare_every_step(StepByStepRun run) {
  std::uint32_t most = 0;
  std::optional<Inversion> first;
  std::uint32_t differences = 0;
  const Inversions& reported = run.body->inversions();
  while (run.advance()) {
    const std::vector<std::uint32_t> now = run.inverted();
    most = std::max(most, static_cast<std::uint32_t>(now.size()));
    if (!first && !now.empty())
      first = Inversion{now.front(), run.body->positions()[run.model->corners[now.front()].node[0]],
                        run.body->time()};
    if (reported.most != most || reported.first.has_value() != first.has_value()) ++differences;
  }
  CHECK(differences == 0);
  REQUIRE(reported.first.has_value() == first.has_value());
  if (!first) return 0;
  CHECK(reported.first->corner == first->corner);
  CHECK(reported.first->time == first->time);
  CHECK((reported.first->place - first->place).norm() < 1e-12);
  return most;
}

}  // namespace

TEST_CASE("No inversion of a hard throw without volumes is missed, in any step") {
  static const LodChain chain = test::soft_bar(1e-3);
  const std::uint32_t level = GENERATE(0U, 1U);
  const bool at_surface = GENERATE(false, true);
  for (const Integrator integrator :
       {Integrator::symplectic_euler, Integrator::velocity_verlet, Integrator::runge_kutta_4}) {
    for (const Layout layout : {Layout::fastest, Layout::any_shape}) {
      if (layout != Layout::fastest && integrator != Integrator::symplectic_euler) continue;
      CAPTURE(level, at_surface, to_string(integrator), to_string(layout));
      const MassSpringModel& model = chain.levels[level].model;
      const RunOptions options{.integrator = integrator,
                               .volumes = false,
                               .layout = layout,
                               .skin = test::contacts_at(chain, level, at_surface)};
      CHECK(compare_every_step({model, test::bar_throw(12), options,
                                0.2 * step_limit(model, integrator).step}) > 100);
    }
  }
}

// Corners that resist move nodes after the look at the corners of a step, so a corner that they
// turn over is found a step later, if it is still inside out.
TEST_CASE("Where corners resist, one that is inside out for two steps is reported") {
  static const LodChain chain = test::soft_bar(0);
  std::uint32_t turned = 0;
  for (const std::uint32_t level : {0U, 1U})
    for (const bool at_surface : {false, true})
      for (const Integrator integrator :
           {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
        CAPTURE(level, at_surface, to_string(integrator));
        const MassSpringModel& model = chain.levels[level].model;
        const RunOptions options{.integrator = integrator,
                                 .skin = test::contacts_at(chain, level, at_surface)};
        StepByStepRun run(model, test::bar_throw(20), options,
                          0.7 * step_limit(model, integrator).step);
        std::vector<std::uint32_t> before;
        std::uint32_t most = 0;
        std::uint32_t most_of_two = 0;
        std::optional<double> first;
        while (run.advance()) {
          const std::vector<std::uint32_t> now = run.inverted();
          std::vector<std::uint32_t> both;
          std::set_intersection(before.begin(), before.end(), now.begin(), now.end(),
                                std::back_inserter(both));
          most = std::max(most, static_cast<std::uint32_t>(now.size()));
          most_of_two = std::max(most_of_two, static_cast<std::uint32_t>(both.size()));
          if (!both.empty() && !first) first = run.body->time();
          before = now;
        }
        const Inversions& reported = run.body->inversions();
        CHECK(reported.most <= most);
        CHECK(reported.most >= most_of_two);
        REQUIRE(reported.first.has_value() >= first.has_value());
        if (first) CHECK(reported.first->time <= *first);
        CHECK(before.empty());
        turned += most_of_two;
      }
  CHECK(turned > 0);
}
