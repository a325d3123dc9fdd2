#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "elastic/loads.hpp"
#include "tests/elastic/elastic_samples.hpp"
#include "tests/support/models.hpp"

namespace springlod::elastic {
namespace {

Vec3 total(const StaticLoad& load) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& force : load.force) sum += force;
  return sum;
}

Vec3 moment(const MassSpringModel& model, const StaticLoad& load) {
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t i = 0; i < model.node_count(); ++i) sum += model.rest[i].cross(load.force[i]);
  return sum;
}

double amount(const StaticLoad& load) {
  double sum = 0;
  for (const Vec3& force : load.force) sum += force.norm();
  return sum;
}

MassSpringModel bar() {
  MassSpringModel model = test::corners_box(4, 3, 9, 0.1, 1e6, 1000);
  Box3 inside = bounds(model.rest);
  inside.min().array() += 0.05;
  inside.max().array() -= 0.05;
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    model.border[i] = inside.contains(model.rest[i]) ? 0 : 1;
  return model;
}

const MassSpringModel kBar = bar();

TEST_CASE("Local loads act on border nodes only, with at most 1 N on a patch") {
  for (const StaticLoad& load : patch_pairs(kBar, {.radius = 1.5})) {
    CHECK(amount(load) <= Approx(2));  // close patches share nodes, where forces cancel
    CHECK(amount(load) > 0.5);
  }
  for (const StaticLoad& load : pinches(kBar, {.radius = 1.5})) {
    CHECK(amount(load) <= Approx(2));
    CHECK(amount(load) > 0.5);
  }
  for (const StaticLoad& load : pushes(kBar, {})) {
    CHECK(amount(load) == Approx(1));
    for (std::uint32_t i = 0; i < kBar.node_count(); ++i)
      if (kBar.border[i] == 0) CHECK(load.force[i].isZero());
  }
}

TEST_CASE(
    "Forces of two patches cancel, along their line also the moments, up to the patch width") {
  for (const auto& loads : {patch_pairs(kBar, {.count = 10}), pinches(kBar, {.count = 10})}) {
    REQUIRE(loads.size() == 10);
    for (const StaticLoad& load : loads) CHECK(total(load).norm() < 1e-12);
  }
  for (const StaticLoad& load : pinches(kBar, {.count = 10, .radius = 1.5}))
    CHECK(moment(kBar, load).norm() < 0.1);  // the radius of a patch is 0.2 m
}

TEST_CASE("A pinch compresses along the surface normal") {
  for (const StaticLoad& load : pinches(kBar, {.count = 20, .radius = 1.5})) {
    double work = 0;  // along the inward direction from the centre
    for (std::uint32_t i = 0; i < kBar.node_count(); ++i)
      work += load.force[i].dot(bounds(kBar.rest).center() - kBar.rest[i]);
    CHECK(work > 0.1);
  }
}

TEST_CASE("Local loads depend on the seed only") {
  const auto first = pushes(kBar, {.count = 3, .seed = 5});
  const auto again = pushes(kBar, {.count = 3, .seed = 5});
  const auto other = pushes(kBar, {.count = 3, .seed = 6});
  CHECK(first[2].force == again[2].force);
  CHECK(first[2].force != other[2].force);
  CHECK(first[2].name == "push 3");
}

TEST_CASE("Local loads need a surface, a body too small for two patches has no pairs") {
  MassSpringModel inner = kBar;
  inner.border.assign(inner.node_count(), 0);
  CHECK_THROWS_AS(pushes(inner, {}), InputError);
  MassSpringModel pair = test::table_model({{0, 0, 0}, {1, 0, 0}}, {1, 1}, {{0, 1, 100}});
  pair.border = {1, 1};
  CHECK(patch_pairs(pair, {}).empty());
}

}  // namespace
}  // namespace springlod::elastic
