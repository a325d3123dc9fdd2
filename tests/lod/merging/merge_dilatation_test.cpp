#include "lod/merging/merge_dilatation.hpp"

#include <numeric>

#include <catch2/catch.hpp>

#include "elastic/elastic_body.hpp"
#include "elastic/modes.hpp"
#include "lod/build.hpp"
#include "lod/merging/merge.hpp"
#include "tests/support/dilatation.hpp"
#include "tests/support/soft_blocks.hpp"

using namespace springlod;
using namespace springlod::lod;
using namespace springlod::test;

namespace {

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

TEST_CASE("Merged levels keep the sum of the moduli of their terms, and have six zero modes") {
  const double nu = GENERATE(-0.1, 0.1, 0.45, 0.49);
  const auto grouping = GENERATE(Grouping::standard, Grouping::compact);
  const MassSpringModel base = soft_block(6, 6, 8, nu);
  const LodChain chain =
      simplify(base, {.levels = 2, .grouping = {.grouping = grouping, .seed = 3}});
  for (const Level& level : chain.levels) {
    validate(level.model);
    CHECK(sum(level.model.dilatation.modulus) == Approx(sum(base.dilatation.modulus)));
    const elastic::ElasticBody body = elastic::elastic_body(level.model);
    CHECK(body.zero_mode_count() == 6);
    CHECK(elastic::lowest_modes(body, {.count = 1}).modes.front().angular_frequency > 0);
  }
}

TEST_CASE("Merged levels without terms in their base have none") {
  const LodChain chain = simplify(soft_block(4, 4, 4, kSpringPoisson), {.levels = 1});
  CHECK(chain.levels[1].model.dilatation.empty());
}

TEST_CASE("Terms keep the damping time of their material when they are merged") {
  const MassSpringModel base = soft_block(5, 5, 5, 0.4);
  const LodChain chain = simplify(base, {.levels = 2});
  for (const Level& level : chain.levels)
    for (const double time : level.model.dilatation.damping_time)
      CHECK(time == Approx(0.0002).epsilon(1e-12));
}
