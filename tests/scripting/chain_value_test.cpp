#include <catch2/catch.hpp>

#include "lod/build.hpp"
#include "scripting/bind/tables/run_options.hpp"
#include "scripting/bind/tables/values.hpp"
#include "tests/support/bodies.hpp"

using namespace springlod;
using namespace springlod::scripting;

namespace {

std::shared_ptr<const ChainValue> chain_of(const MassSpringModel& base) {
  LodAsset asset;
  asset.chain = lod::simplify(base, {.levels = 2});
  asset.chain.contact = ContactAt::surface;
  return std::make_shared<const ChainValue>(std::move(asset));
}

}  // namespace

TEST_CASE("A chain lays out the contact skin of a level once, for all runs of the level") {
  const auto chain = chain_of(test::block(4, 4, 4));
  const auto skin = skin_of(*level_value(chain, 2), {});
  REQUIRE(skin != nullptr);
  CHECK(skin_of(*level_value(chain, 2), {}) == skin);
  CHECK(skin_of(*level_value(chain, 2), ContactAt::surface) == skin);
  CHECK(skin_of(*level_value(chain, 1), {}) != skin);
  CHECK(skin->area == sim::contact_skin(chain->chain, 2).area);
  CHECK(skin_of(*level_value(chain, 2), ContactAt::nodes) == nullptr);
  CHECK(skin_of(*level_value(chain, 0), {}) == nullptr);
}

TEST_CASE("A copy of a chain that is changed has contact skins of its own") {
  const auto chain = chain_of(test::block(4, 4, 4));
  const auto skin = chain->skin(1);
  LodAsset copy = *chain;
  for (double& area : copy.chain.levels[0].model.contact_area) area *= 2;
  const ChainValue changed(std::move(copy));
  CHECK(changed.skin(1)->area[0] == Approx(2 * skin->area[0]));
}
