#include "sim/study/ensemble.hpp"

#include <string>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "sim/integrators/step_limit.hpp"
#include "sim/study/compare.hpp"
#include "tests/sim/scenes.hpp"

using namespace springlod;
using namespace springlod::sim;

namespace {

Scenario scene() {
  return test::small_scene(0.5);
}

}  // namespace

TEST_CASE("An ensemble runs the starts that compare runs") {
  CompareOptions compared;
  compared.starts = 4;
  const Comparison comparison = compare(test::small_chain(), scene(), compared);
  EnsembleOptions options;
  options.starts = 4;
  for (std::size_t level = 0; level < test::small_chain().levels.size(); ++level) {
    const auto runs = run_ensemble(test::small_chain().levels[level].model, scene(), options);
    REQUIRE(runs.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) {
      const StartResult& start = comparison.levels[level].starts[i];
      CHECK(runs[i].start == i);
      CHECK(runs[i].distance == start.distance);
      CHECK(runs[i].spring_updates == start.spring_updates);
      CHECK(runs[i].simulated == start.simulated);
    }
  }
}

TEST_CASE("An ensemble is the same in parts and for any number of threads", "[threaded]") {
  const MassSpringModel& model = test::small_chain().levels[1].model;
  EnsembleOptions options;
  options.starts = 6;
  options.threads = 1;
  const auto whole = run_ensemble(model, scene(), options);
  options.threads = 2;
  options.first_start = 3;
  options.starts = 3;
  const auto part = run_ensemble(model, scene(), options);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(part[i].start == whole[i + 3].start);
    CHECK(part[i].distance == whole[i + 3].distance);
  }
  CHECK(whole[4].distance != whole[5].distance);
}

TEST_CASE("An ensemble refuses what it cannot run, and names the start that diverged") {
  EnsembleOptions options;
  options.starts = 0;
  CHECK_THROWS_AS(run_ensemble(test::small_chain().levels[0].model, scene(), options), InputError);
  options.starts = 2;
  options.jitter = 1;
  CHECK_THROWS_AS(run_ensemble(test::small_chain().levels[0].model, scene(), options), InputError);
  options.jitter = 0.02;
  options.run.step = 3 * predicted_step(test::small_chain().levels[0].model);
  try {
    run_ensemble(test::small_chain().levels[0].model, scene(), options);
    FAIL("stable at three times the predicted step");
  } catch (const UnstableError& e) {
    CHECK_THAT(e.what(), Catch::Matchers::StartsWith("start 1: "));
  }
}

TEST_CASE("Ensemble runs report when corners were inside out, or that none was") {
  Scenario violent = scene();
  violent.start.velocity = {0, 0, -120};  // far above the speed of sound of the block, 32 m/s
  violent.obstacles = {test::floor(1e8, 0.5)};
  violent.duration = 0.02;
  CompareOptions compared;
  compared.starts = 2;
  compared.run.volumes = false;
  const Comparison comparison = compare(test::small_chain(), violent, compared);
  EnsembleOptions options{.starts = 2};
  options.run.volumes = false;
  const auto runs = run_ensemble(test::small_chain().levels[0].model, violent, options);
  for (std::size_t i = 0; i < 2; ++i) {
    REQUIRE(runs[i].first_inversion.has_value());
    CHECK(*runs[i].first_inversion > 0.001);
    CHECK(runs[i].most_inverted > 0);
    CHECK(runs[i].first_inversion == comparison.levels[0].starts[i].first_inversion);
    CHECK(runs[i].inverted_at_end == comparison.levels[0].starts[i].inverted_at_end);
  }
  const auto calm = run_ensemble(test::small_chain().levels[0].model, scene(), {.starts = 1});
  CHECK_FALSE(calm[0].first_inversion);
  CHECK(calm[0].most_inverted == 0);
}
