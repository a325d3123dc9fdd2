#include "sim/study/pick.hpp"

#include <limits>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "lod/quality/certify.hpp"
#include "sim/study/compare.hpp"
#include "sim/study/predict.hpp"
#include "tests/sim/scenes.hpp"

using namespace springlod;
using namespace springlod::sim;
using Catch::Contains;

namespace {

const LodChain& certified_chain() {
  static const LodChain chain = [] {
    LodChain made = test::small_chain();
    lod::certify(made);
    return made;
  }();
  return chain;
}

Scenario scene() {
  return test::small_scene(0.7);
}

double diagonal() {
  return bounds(test::small_chain().levels[0].model.rest).diagonal().norm();
}

std::optional<std::uint32_t> chosen(std::vector<PickLevel> levels, const PickOptions& options) {
  return choose_level(levels, options);
}

}  // namespace

TEST_CASE("The pick is the coarsest level within the error, whatever finer levels do") {
  const std::vector<PickLevel> levels{{.level = 0, .error = 0, .cost = 8},
                                      {.level = 1, .error = 0.01, .cost = 4},
                                      {.level = 2, .error = 0.03, .cost = 2},
                                      {.level = 3, .error = 0.02, .cost = 1}};
  CHECK(chosen(levels, {.error = 0.02}) == 3U);
  CHECK(chosen(levels, {.error = 0.015}) == 1U);
  CHECK(chosen(levels, {.error = 0.001}) == 0U);
  std::vector<PickLevel> marked = levels;
  choose_level(marked, {.error = 0.02});
  CHECK(marked[1].within);
  CHECK_FALSE(marked[2].within);
}

TEST_CASE("The pick is the most accurate level within the budget, or none") {
  const std::vector<PickLevel> levels{{.level = 0, .error = 0, .cost = 8},
                                      {.level = 1, .error = 0.03, .cost = 4},
                                      {.level = 2, .error = 0.01, .cost = 2},
                                      {.level = 3, .error = 0.02, .cost = 1}};
  CHECK(chosen(levels, {.budget = 10}) == 0U);
  CHECK(chosen(levels, {.budget = 5}) == 2U);
  CHECK(chosen(levels, {.budget = 1}) == 3U);
  CHECK(chosen(levels, {.budget = 0.5}) == std::nullopt);
}

TEST_CASE("A measured pick has the errors of compare") {
  const Pick pick =
      pick_level(test::small_chain(), scene(), {.error = 0.02, .measure = true, .threads = 1});
  CompareOptions options;
  options.threads = 1;
  const Comparison runs = compare(test::small_chain(), scene(), options);
  REQUIRE(pick.levels.size() == 3);
  for (std::size_t level = 0; level < 3; ++level) {
    CHECK(pick.levels[level].error * diagonal() ==
          Approx(runs.levels[level].starts[0].surface_error));
    CHECK(pick.levels[level].cost > 0);
  }
}

TEST_CASE("A predicted pick agrees with the measured errors within a factor of three") {
  const Pick predicted = pick_level(certified_chain(), scene(), {.error = 0.02});
  const Pick measured = pick_level(certified_chain(), scene(), {.error = 0.02, .measure = true});
  CHECK(predicted.levels[0].error == 0);
  for (std::size_t level = 1; level < 3; ++level) {
    CAPTURE(level, predicted.levels[level].error, measured.levels[level].error);
    CHECK(predicted.levels[level].error < 3 * measured.levels[level].error);
    CHECK(predicted.levels[level].error > measured.levels[level].error / 3);
    CHECK(predicted.levels[level].cost > 0);
  }
}

TEST_CASE("One and two threads predict the same bits", "[threaded]") {
  PredictOptions options;
  options.threads = 1;
  const Prediction one = predict_errors(certified_chain(), scene(), options);
  options.threads = 2;
  const Prediction two = predict_errors(certified_chain(), scene(), options);
  CHECK(one.first_contact == two.first_contact);
  CHECK(one.spring_updates == two.spring_updates);
  for (std::size_t level = 0; level < 3; ++level) {
    CHECK(one.levels[level].error == two.levels[level].error);
    CHECK(one.levels[level].contact == two.levels[level].contact);
  }
}

TEST_CASE("A prediction runs much less than the base and names the cause of an error") {
  const Prediction at_nodes = predict_errors(certified_chain(), scene(), {});
  PredictOptions options;
  options.contact = ContactAt::surface;
  const Prediction at_surface = predict_errors(certified_chain(), scene(), options);
  for (std::size_t level = 1; level < 3; ++level) {
    CHECK(at_nodes.levels[level].contact > 0);
    CHECK(at_surface.levels[level].contact == 0);
    CHECK(at_nodes.levels[level].impulse > 0);
  }
  const Trajectory base = run(certified_chain().levels[0].model, scene());
  CHECK(at_nodes.spring_updates < base.spring_updates);

  Scenario falling = scene();
  falling.obstacles.clear();
  falling.start.spin = Vec3::Zero();
  const Prediction free_fall = predict_errors(certified_chain(), falling, {});
  CHECK_FALSE(free_fall.first_contact);
  CHECK(free_fall.end == falling.duration);
  // The stiffer probe has a shorter step, so its fall differs by a fraction of g t dt / 2.
  for (const PredictedError& level : free_fall.levels) CHECK(level.error < 3e-4 * diagonal());
}

TEST_CASE("A window of no time after a contact at the start has no error") {
  Scenario lying = scene();
  lying.start = {};
  lying.obstacles = {test::floor(1e6, 0.5)};
  const double lowest = bounds(certified_chain().levels[0].model.rest).min().z();
  lying.obstacles[0].shape = Plane{Vec3::UnitZ(), lowest + 1e-3};
  PredictOptions options;
  options.error_window = 0;
  const Prediction prediction = predict_errors(certified_chain(), lying, options);
  CHECK(prediction.end < 0.01);
  for (const PredictedError& level : prediction.levels) CHECK(level.error < 0.01 * diagonal());
}

TEST_CASE("A level without springs is never picked for its error") {
  LodChain chain = certified_chain();
  MassSpringModel node;
  node.rest = {Vec3::Zero()};
  node.mass = node.volume = node.contact_area = {1};
  node.border = {1};
  node.material = {0};
  node.materials = chain.levels[2].model.materials;
  const std::vector<std::uint32_t> all(chain.levels[0].model.node_count(), 0);
  chain.levels.push_back({.model = node, .of_base = {all, 1}, .made_by = "by hand"});
  const Pick pick = pick_level(chain, scene(), {.error = 0.9});
  CHECK(pick.levels[3].error == std::numeric_limits<double>::infinity());
  CHECK(pick.level == 2U);
}

TEST_CASE("pick refuses requests and chains that it cannot serve") {
  const LodChain& chain = certified_chain();
  CHECK_THROWS_WITH(pick_level(chain, scene(), {}), Contains("give error"));
  CHECK_THROWS_WITH(pick_level(chain, scene(), {.error = 0.1, .budget = 0.1}),
                    Contains("give one of them"));
  CHECK_THROWS_WITH(pick_level(chain, scene(), {.error = 2}), Contains("\"2 %\""));
  CHECK_THROWS_AS(pick_level(chain, scene(), {.error = 0}), InputError);
  CHECK_THROWS_AS(pick_level(chain, scene(), {.budget = 0}), InputError);
  CHECK_THROWS_AS(pick_level(chain, scene(), {.error = 0.1, .run = {.frame_rate = 0}}), InputError);
  CHECK_THROWS_WITH(pick_level(test::small_chain(), scene(), {.error = 0.1}),
                    Contains("level 1 has no certificate"));
  LodChain base_only;
  base_only.levels.push_back(chain.levels[0]);
  CHECK_THROWS_WITH(pick_level(base_only, scene(), {.error = 0.1}), Contains("only its base"));
}
