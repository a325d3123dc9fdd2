#include "sim/study/twin.hpp"

#include <numeric>

#include <catch2/catch.hpp>

#include "model/binding.hpp"
#include "tests/sim/scenes.hpp"

using namespace springlod;
using namespace springlod::sim;

TEST_CASE("A level as the skin of itself has its own nodes as contact points") {
  const LodChain& chain = test::small_chain();
  const MassSpringModel& body = chain.levels[2].model;
  const ContactSkin skin = nodes_of_level_as_skin(chain, 2, 2);
  validate(skin, body.node_count());
  const std::vector<Vec3> points = interpolate(skin.of_nodes, body.rest);
  for (std::size_t p = 0; p < points.size(); ++p) {
    CHECK((points[p] - body.rest[skin.base_node[p]]).norm() < 1e-12);
    CHECK(skin.area[p] == body.contact_area[skin.base_node[p]]);
    CHECK(skin.compliance[p].isZero(0));
  }
}

TEST_CASE("A twin touches at the nodes of the finer level, with their area and a compliance") {
  const LodChain& chain = test::small_chain();
  const MassSpringModel& fine = chain.levels[1].model;
  const MassSpringModel& body = chain.levels[2].model;
  const ContactSkin skin = nodes_of_level_as_skin(chain, 1, 2);
  validate(skin, body.node_count());
  const std::vector<Vec3> points = interpolate(skin.of_nodes, body.rest);
  double farthest = 0;
  double compliant = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    farthest = std::max(farthest, (points[p] - fine.rest[skin.base_node[p]]).norm());
    if (!skin.compliance[p].isZero(0)) ++compliant;
  }
  CHECK(farthest < 0.5 * mean_spring_length(body));
  CHECK(compliant > 0);
  CHECK(std::accumulate(skin.area.begin(), skin.area.end(), 0.0) ==
        Approx(std::accumulate(fine.contact_area.begin(), fine.contact_area.end(), 0.0)));
}

TEST_CASE("A stiffened model has all stiffnesses and dampings times the factor") {
  const MassSpringModel& model = test::small_chain().levels[1].model;
  const MassSpringModel stiff = stiffened(model, 1.5);
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    CHECK(stiff.stiffness[s] == 1.5 * model.stiffness[s]);
    CHECK(stiff.damping[s] == 1.5 * model.damping[s]);
    CHECK(stiff.rest_length[s] == model.rest_length[s]);
  }
}
