// Closed form for eq. 66 of docs/method.md: a block sliding at 3 m/s, mu = 0.3, g = 10 stops after
// v^2 / (2 mu g).
#include <catch2/catch.hpp>

#include "sim/run.hpp"
#include "tests/sim/scenes.hpp"

using namespace springlod;
using namespace springlod::sim;

namespace {

/// The body lies on the floor; its lowest contact node just touches it.
Scenario slide(const MassSpringModel& model) {
  double lowest = model.rest[0].z();
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    if (model.contact_area[i] > 0) lowest = std::min(lowest, model.rest[i].z());
  Scenario scene;
  scene.gravity = {0, 0, -10};
  scene.obstacles = {test::floor(2e7, 0.3)};
  scene.obstacles[0].damping = 0.001;
  scene.start.placed = true;
  scene.start.position = {0, 0, mass_properties(model).center.z() - lowest};
  scene.start.velocity = {3, 0, 0};
  scene.duration = 1.3;  // stops at 1 s
  return scene;
}

}  // namespace

TEST_CASE("A sliding block stops after 1.5 m on every level of a chain", "[long]") {
  // Long and low, so that friction does not tip it over; stiff, so that its vibration after the
  // stop is small.
  const auto style = GENERATE(voxelize::LatticeStyle::corners, voxelize::LatticeStyle::centers);
  const auto base = test::block(12, 8, 4, 0.1, test::material("block", 1e7, 1000, 0.001), style);
  const auto border = GENERATE(lod::BorderRule::none, lod::BorderRule::weak);
  lod::SimplifyOptions options;
  options.grouping.border = border;
  const LodChain chain = lod::simplify(base, options);
  REQUIRE(chain.levels.size() == 3);
  const bool at_surface = GENERATE(false, true);
  for (std::size_t level = 0; level < chain.levels.size(); ++level) {
    const MassSpringModel& model = chain.levels[level].model;
    const Scenario scene = slide(at_surface ? base : model);
    RunOptions how{.frame_rate = 0};
    if (at_surface)
      how.skin =
          std::make_shared<ContactSkin>(contact_skin(chain, static_cast<std::uint32_t>(level)));
    const auto t = run(model, scene, how);
    const double way =
        measured_distance(scene, scene.start.position, center_of_mass(model, t.final.x));
    INFO("style " << static_cast<int>(style) << " border " << to_string(border) << " level "
                  << level << " at surface " << at_surface << " nodes " << model.node_count()
                  << " way " << way);
    CHECK(way == Approx(1.5).epsilon(0.01));
    CHECK(closure_error(t.ledger) < 0.01);
  }
}
