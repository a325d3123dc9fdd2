// Targets of a calibration beside those of the whole body: regions of the surface, and weights.

#include <algorithm>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "lod/build.hpp"
#include "lod/calibration/calibrate.hpp"
#include "lod/calibration/elastic_fit.hpp"
#include "lod/quality/certify.hpp"
#include "lod/quality/compared_loads.hpp"
#include "tests/support/bodies.hpp"

using namespace springlod;
using namespace springlod::lod;
using springlod::test::block;

namespace {

constexpr double kCell = 0.1;  // [m], of block()

std::vector<std::uint32_t> below(const MassSpringModel& model, double z) {
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    if (model.rest[i].z() < z) nodes.push_back(i);
  return nodes;
}

std::size_t count_of(const ElasticTargets& targets, LoadKind kind) {
  return static_cast<std::size_t>(std::count_if(targets.loads.begin(), targets.loads.end(),
                                                [&](const auto& l) { return l.kind == kind; }));
}

/// Mean error of the held-out loads within `region` for a level of a fifth of the nodes.
double error_within(const MassSpringModel& base, const std::vector<std::uint32_t>& region,
                    const TargetOptions& targets) {
  SimplifyOptions options{.levels = 1,
                          .keep = {0.2},
                          .grouping = {.grouping = Grouping::compact},
                          .calibrate = Calibrate::modes};
  options.calibration.targets = targets;
  LodChain chain = simplify(base, options);
  certify(chain, {.within = region, .anchored = targets.anchored});
  return mean_load_error(*chain.levels[1].certificate, true);
}

}  // namespace

TEST_CASE("A target region reduces the error of held-out loads within it", "[long]") {
  const MassSpringModel base = block(5, 5, 14);
  const std::vector<std::uint32_t> face = below(base, kCell);
  const double without = error_within(base, face, {});
  const double with = error_within(base, face, {.regions = {{.nodes = face}}});
  CAPTURE(without, with);
  // A fit without the region is 8 % off there.
  CHECK(with < 0.75 * without);
  CHECK(with < 0.06);
}

TEST_CASE("A target region next to an anchored end reduces the error as well", "[long]") {
  const MassSpringModel base = block(5, 5, 14);
  const std::vector<std::uint32_t> near = below(base, 4.4 * kCell);
  TargetOptions options{.anchored = below(base, kCell)};
  const double without = error_within(base, near, options);
  options.regions = {{.nodes = near}};
  const double with = error_within(base, near, options);
  CAPTURE(without, with);
  CHECK(with < 0.9 * without);
}

TEST_CASE("The targets have the requested kinds and weights") {
  const MassSpringModel base = test::rods();
  const std::vector<std::uint32_t> end = below(base, 3 * kCell);
  const ElasticTargets targets =
      measure_targets(base, identity_groups(base.node_count()),
                      {.modes = 2,
                       .patches = 6,
                       .patch_weight = 0.25,
                       .regions = {{.nodes = end, .weight = 3, .patches = 8},
                                   {.nodes = below(base, kCell), .patches = 4}},
                       .load_weight = 2});
  CHECK(count_of(targets, LoadKind::smooth) == 9);
  CHECK(count_of(targets, LoadKind::piece) == 27);
  CHECK(count_of(targets, LoadKind::patch) == 6);
  CHECK(count_of(targets, LoadKind::region) == 12);
  for (const LoadTarget& target : targets.loads) {
    if (target.kind == LoadKind::smooth) CHECK(target.weight == 2);
    if (target.kind == LoadKind::patch) CHECK(target.weight == 0.5);
    if (target.kind != LoadKind::region) continue;
    CHECK(target.weight == (target.load.name.ends_with("of region 1") ? 6 : 2));
    for (std::uint32_t i = 0; i < base.node_count(); ++i)
      if (base.rest[i].z() >= 3 * kCell) CHECK(target.load.force[i].isZero());
  }
}

TEST_CASE("Weights of modes, shapes and loads scale their residuals") {
  const MassSpringModel base = block(4, 4, 5);
  const Level level = simplify(base, {.levels = 1}).levels[1];
  const auto residuals = [&](const TargetOptions& options) {
    const ElasticTargets targets = measure_targets(base, level.of_base, options);
    return ElasticFit(level.model, level.of_base, targets).residuals(level.model).weighted;
  };
  const Eigen::VectorXd usual = residuals({.modes = 4, .patches = 2});
  const Eigen::VectorXd weighted = residuals(
      {.modes = 4, .patches = 2, .mode_weight = 2, .shape_weight = 3, .load_weight = 0.5});
  REQUIRE(usual.size() == weighted.size());
  const Eigen::Index loads = 11, shapes = 4 * 5 / 2, modes = usual.size() - loads - shapes;
  CHECK(weighted.head(modes).isApprox(2 * usual.head(modes)));
  CHECK(weighted.segment(modes, loads).isApprox(0.5 * usual.segment(modes, loads)));
  CHECK(weighted.tail(shapes).isApprox(3 * usual.tail(shapes)));
}

TEST_CASE("Weights below 0 and regions without free border nodes are errors") {
  const MassSpringModel base = block(4, 4, 5);
  const Groups alone = identity_groups(base.node_count());
  CHECK_THROWS_WITH(measure_targets(base, alone, {.mode_weight = -1}),
                    Catch::Contains("mode_weight = -1 must be 0 or more"));
  CHECK_THROWS_WITH(
      measure_targets(base, alone, {.regions = {{.nodes = {0}, .weight = std::nan("")}}}),
      Catch::Contains("weight of a region"));
  LodChain chain = simplify(base, {.levels = 1});
  CalibrateOptions options;
  options.targets.regions = {{.nodes = {0}}, {.nodes = below(base, kCell)}};
  options.targets.anchored = below(base, kCell);
  CHECK_THROWS_WITH(calibrate(chain, options), Catch::Contains("nodes of region 1"));
  options.targets.regions.erase(options.targets.regions.begin());
  CHECK_THROWS_AS(calibrate(chain, options), InputError);
}

TEST_CASE("Held-out loads can be restricted to some nodes") {
  const MassSpringModel base = block(4, 4, 8);
  const std::vector<std::uint32_t> face = below(base, kCell);
  const ComparedLoads loads = compared_loads(base, {.count = 5, .within = face});
  CHECK(loads.smooth == 9);
  REQUIRE(loads.all.size() == 19);
  CHECK_FALSE(loads.held_out(8));
  for (std::size_t l = 14; l < loads.all.size(); ++l) {  // the pushes
    CHECK(loads.held_out(l));
    for (std::uint32_t i = 0; i < base.node_count(); ++i)
      if (base.rest[i].z() >= kCell) CHECK(loads.all[l].force[i].isZero());
  }
  CHECK(compared_loads(base, {.count = 0}).all.size() == 9);
  const std::uint32_t inside = static_cast<std::uint32_t>(
      std::find(base.border.begin(), base.border.end(), 0) - base.border.begin());
  CHECK_THROWS_WITH(compared_loads(base, {.within = {inside}}), Catch::Contains("border node"));
}
