// Files for engines. tests/peers has the engines read them.

#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "elastic/stable_step.hpp"
#include "report/export/arrays.hpp"
#include "report/export/draft.hpp"
#include "report/export/substep_window.hpp"
#include "tests/support/lattices.hpp"

using namespace springlod;
using namespace springlod::report;
using namespace springlod::test;
using Catch::Matchers::Contains;

namespace {

constexpr double kEarth = 9.81;

MassSpringModel block(double stiffness) {
  return box_lattice(3, 3, 4, 0.1, stiffness);
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

}  // namespace

TEST_CASE("two nodes on a spring have the frequency of their single vibration") {
  const MassSpringModel pair = make_model({{0, 0, 0}, {1, 0, 0}}, {{0, 1}});
  const SubstepWindow window = substep_window(pair, kEarth, 1);
  CHECK(window.frequency == Approx(elastic::largest_frequency(pair)));
}

TEST_CASE("the window of substeps holds the recommended rate and what it promises") {
  const SubstepWindow window = substep_window(block(1e4), kEarth, 0.2);
  REQUIRE_FALSE(window.empty());
  CHECK(window.from < window.rate);
  CHECK(window.rate < window.to);
  CHECK(window.error <= kWindowError);
  // Sweeps that leave 2 % by their order alone need fewer substeps than all errors together.
  CHECK(window.from > 0.999 * window.frequency * std::sqrt(kOrderError / kWindowError));
  CHECK_THAT(joined(describe_window(window)),
             Contains("expect an error of up to 1 %; at most 2 % from"));
}

TEST_CASE("a stiff body in single precision has no window, and the report says what to do") {
  const SubstepWindow window = substep_window(block(1e9), kEarth, 0.2);
  CHECK(window.empty());
  CHECK(window.error > kWindowError);
  CHECK_THAT(joined(describe_window(window)),
             Contains("expect an error of") && Contains("the least of all rates") &&
                 Contains("coarser level") && Contains("times as soft"));
}

TEST_CASE("a quarter of the stiffness halves the least error of a body without a window") {
  const SubstepWindow stiff = substep_window(block(1e9), kEarth, 0.2);
  const SubstepWindow soft = substep_window(block(0.25e9), kEarth, 0.2);
  REQUIRE(soft.empty());
  CHECK(soft.error == Approx(stiff.error / 2).epsilon(0.05));
  CHECK(soft.cheap_softening < stiff.cheap_softening);
  CHECK(soft.cheap_softening > 1);
}

TEST_CASE("stiffness raises the lower end of the window, and size lowers the upper one") {
  const SubstepWindow soft = substep_window(block(1e4), kEarth, 0.2);
  const SubstepWindow hard = substep_window(block(4e4), kEarth, 0.2);
  CHECK(hard.frequency == Approx(2 * soft.frequency));
  CHECK(hard.from > 1.9 * soft.from);
  // The spacing of single precision numbers doubles from 0.2 to 0.4.
  const SubstepWindow large = substep_window(block(1e4), kEarth, 0.4);
  CHECK(large.to == Approx(soft.to / std::sqrt(2)).epsilon(0.01));
  const SubstepWindow weak = substep_window(block(1e4), kEarth / 4, 0.2);
  CHECK(weak.to == Approx(soft.to / 2).epsilon(0.02));
}

TEST_CASE("a body without springs takes one substep a frame") {
  const MassSpringModel point = make_model({{1, 2, 3}}, {});
  const SubstepWindow window = substep_window(point, kEarth, 1);
  CHECK(frame_substeps(window).per_frame == 1);
  for (const auto draft : {draft_jolt, draft_mujoco, draft_bullet})
    CHECK_FALSE(draft({.model = point}).files.empty());
}

TEST_CASE("engines with y up take the body about its middle, turned and not mirrored") {
  const MassSpringModel pair = make_model({{1, 2, 3}, {3, 2, 3}, {1, 5, 3}, {1, 2, 9}}, {});
  const SingleBody body = single_body({.model = pair});
  CHECK(body.center == std::array<float, 3>{2, 6, -3.5F});
  CHECK(body.extent == 3);
  const auto edge = [&](std::size_t node) -> Vec3 {
    const float* p = body.position.data();
    return Vec3(p[3 * node], p[3 * node + 1], p[3 * node + 2]) - Vec3(p[0], p[1], p[2]);
  };
  CHECK(edge(1).cross(edge(2)).dot(edge(3)) > 0);
  CHECK(edge(3).y() == 6);
}

TEST_CASE("numbers of C++ are single, and lines are short") {
  const std::vector<float> values{1, 0.5F, 1e-8F, -3};
  CHECK(list(values, true) == "1,0.5F,1e-08F,-3,");
  CHECK(list(values, false) == "1,0.5,1e-08,-3,");
  const std::vector<float> many(100, 0.25F);
  for (std::size_t start = 0, end = 0; end != std::string::npos; start = end + 1) {
    end = list(many, true).find('\n', start);
    CHECK(std::min(end, list(many, true).size()) - start <= 100);
  }
}

TEST_CASE("exports for engines state what they lose") {
  const MassSpringModel model = block(1e4);
  MassSpringModel damped = model;
  damped.damping.assign(damped.spring_count(), 1);
  CHECK_THAT(joined(draft_jolt({.model = damped}).losses), Contains("damping of springs"));
  CHECK_THAT(joined(draft_jolt({.model = model}).losses), !Contains("damping of springs"));
  CHECK_THAT(joined(draft_bullet({.model = damped}).losses), Contains("damping of springs"));
  CHECK_THAT(joined(draft_mujoco({.model = damped}).losses), !Contains("damping of springs"));
}

TEST_CASE("the step for MuJoCo is below the stable one and has two digits") {
  const MassSpringModel model = block(1e6);
  const std::string text = draft_mujoco({.model = model, .name = "block"}).files.front().content;
  const std::string key = "timestep=\"";
  const std::size_t at = text.find(key);
  REQUIRE(at != std::string::npos);
  const double step = std::stod(text.substr(at + key.size()));
  const double stable = elastic::stable_step(model);
  CHECK(step <= 0.8 * stable);
  CHECK(step > 0.7 * stable);
}
