#include "sim/held/anchor.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "tests/support/models.hpp"

using namespace springlod;
using namespace springlod::sim;
using Catch::Contains;

TEST_CASE("Anchors that make no sense are refused by name") {
  const MassSpringModel model =
      test::table_model({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {1, 1, 1, 1}, {{0, 1, 1}});
  const Anchor good{.name = "grip", .nodes = {0, 1}};
  CHECK_NOTHROW(validate({good}, model));
  const auto refuses = [&](const std::vector<Anchor>& anchors, const std::string& words) {
    CHECK_THROWS_WITH(validate(anchors, model), Contains(words));
    CHECK_THROWS_AS(validate(anchors, model), InputError);
  };
  refuses({{.name = "grip", .nodes = {}}}, "anchor \"grip\" holds no node");
  refuses({{.name = "grip", .nodes = {100000}}}, "there is no node 100001");
  refuses({good, {.name = "clamp", .nodes = {3, 1}}},
          "anchors \"grip\" and \"clamp\" both hold node 2");
  Anchor bad = good;
  bad.path = {{.time = 0}};
  refuses({bad}, "the time 0 s of a pose on its path must be later than 0 s");
  bad.path = {{.time = 2}, {.time = 1}};
  refuses({bad}, "the time 1 s of a pose on its path must be later than 2 s");
  bad.path = {{.time = 1, .move = {NAN, 0, 0}}};
  refuses({bad}, "its pose at 1 s must be finite");
  bad.path = {};
  bad.pivot = Vec3(0, INFINITY, 0);
  refuses({bad}, "its pivot must be finite");
  bad.pivot.reset();
  bad.spring = AnchorSpring{.stiffness = 0};
  refuses({bad}, "anchor \"grip\": its stiffness of 0 N/m must be finite and above 0");
  bad.spring = AnchorSpring{.stiffness = 1, .damping = -2};
  refuses({bad}, "its damping time of -2 s must be finite and not below 0");
}

TEST_CASE("The nodes of an anchor on springs share its stiffness by mass") {
  const MassSpringModel model =
      test::table_model({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {1, 2, 3, 4}, {{0, 1, 1}});
  const Anchor rope{.name = "rope", .nodes = {3, 0, 3}, .spring = AnchorSpring{.stiffness = 10}};
  const Anchor hook{.name = "hook", .nodes = {1}};
  CHECK(shared_stiffness(rope, model) == std::vector<double>{2, 8});
  const Support support = support_of({rope, hook}, model);
  CHECK(support.nodes == std::vector<std::uint32_t>{1});
  REQUIRE(support.springs.size() == 2);
  CHECK(support.springs[1].node == 3);
  CHECK(support.springs[1].stiffness == 8);
}

TEST_CASE("An anchor of the base holds the groups of its nodes in a level") {
  const Groups groups{.of = {0, 0, 1, 2, 2}, .count = 3};
  const std::vector<Anchor> level =
      mapped({{.name = "a", .nodes = {1}}, {.name = "b", .nodes = {4, 3}}}, groups);
  CHECK(level[0].nodes == std::vector<std::uint32_t>{0});
  CHECK(level[1].nodes == std::vector<std::uint32_t>{2});
  CHECK(level[1].name == "b");
  CHECK(nodes_of(level) == std::vector<std::uint32_t>{0, 2});
}
