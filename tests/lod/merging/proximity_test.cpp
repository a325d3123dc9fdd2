#include <numeric>

#include <catch2/catch.hpp>

#include "lod/build.hpp"
#include "lod/grouping/grouping.hpp"
#include "lod/merging/merge.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/models.hpp"

using namespace springlod;
using namespace springlod::lod;
using namespace springlod::test;

namespace {

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

TEST_CASE("The paper's figure 2: by proximity, mass shifts to neighbours that did not merge") {
  // Six nodes of 1 kg in a row; the two in the middle are merged.
  std::vector<Vec3> points;
  std::vector<TableSpring> springs;
  for (std::uint32_t i = 0; i < 6; ++i) {
    points.emplace_back(i < 3 ? i : i + 0.2, 0, 0);
    if (i > 0) springs.push_back({i - 1, i, 100});
  }
  MassSpringModel row = table_model(points, std::vector<double>(6, 1), springs);
  row.volume.assign(6, 1);  // cubes of 1 m
  const Groups groups = groups_from_sets(row, {{2, 3}});
  MassSpringModel merged = merge(row, groups);
  CHECK(merged.mass == std::vector<double>{1, 1, 2, 1, 1});
  const std::vector<Vec3> rest = merged.rest;
  share_by_proximity(row, merged);
  // The boundaries between the nodes at 1, 2.6 and 4.2 are at 1.8 and 3.4; the merged nodes had
  // pieces at 1.75, 2.25, 2.95 and 3.45.
  CHECK(merged.rest == rest);
  CHECK(merged.mass[0] == 1);
  CHECK(merged.mass[1] == 1.5);
  CHECK(merged.mass[2] == 1);
  CHECK(merged.mass[3] == 1.5);
  CHECK(merged.volume[2] == 1);
  CHECK(sum(merged.mass) == 6);
}

TEST_CASE("By proximity every level has the mass and the volume of the base") {
  for (const MassSpringModel& base : {ball(), rods(), random_model(3, 6)}) {
    SimplifyOptions options;
    options.levels = 3;
    const LodChain proportional = simplify(base, options);
    options.mass = MassRule::proximity;
    const LodChain chain = simplify(base, options);
    for (const Level& level : chain.levels) {
      CHECK(sum(level.model.mass) == Approx(sum(base.mass)).epsilon(1e-12));
      CHECK(sum(level.model.volume) == Approx(sum(base.volume)).epsilon(1e-12));
      CHECK_NOTHROW(validate(level.model));
    }
    CHECK(chain.levels[1].model.rest == proportional.levels[1].model.rest);
    CHECK(chain.levels[1].model.stiffness == proportional.levels[1].model.stiffness);
    CHECK(chain.levels[1].model.mass != proportional.levels[1].model.mass);
    CHECK(chain.levels[1].made_by.find("proximity") != std::string::npos);
  }
}
