#include "lod/group_means.hpp"

#include <vector>

#include <catch2/catch.hpp>

#include "elastic/elastic_body.hpp"
#include "elastic/loads.hpp"
#include "lod/build.hpp"
#include "tests/support/bodies.hpp"

using namespace springlod;
using namespace springlod::lod;
using springlod::test::block;

TEST_CASE("A load does its work along the means of the groups, weighted by mass") {
  const std::vector<Vec3> force{{2, 0, 0}, {0, 0, 0}, {0, 3, 0}};
  const std::vector<Vec3> displacement{{4, 0, 0}, {1, 0, 0}, {0, 5, 0}};
  const std::vector<double> mass{1, 2, 7};
  CHECK(work_on_means(force, displacement, mass, identity_groups(3)) == 2 * 4 + 3 * 5);
  // The first two move together by (1 * 4 + 2 * 1) / 3.
  CHECK(work_on_means(force, displacement, mass, {{0, 0, 1}, 2}) == Approx(2 * 2 + 3 * 5));
}

TEST_CASE("A load whose forces cancel within the groups does no work along their means") {
  const std::vector<Vec3> force{{0.1, 0, 0}, {0.2, 0, 0}, {-0.3, 0, 0}};  // sum: 5.6e-17
  const std::vector<Vec3> displacement{{4, 0, 0}, {5, 0, 0}, {7, 0, 0}};
  CHECK(work_on_means(force, displacement, {1, 1, 1}, {{0, 0, 0}, 1}) == 0);
}

TEST_CASE("The means of groups move less under a load on a few nodes than the nodes do") {
  const MassSpringModel base = block(6, 6, 6);
  const Groups groups =
      simplify(base, {.levels = 1, .keep = {0.3}, .grouping = {.grouping = Grouping::compact}})
          .levels[1]
          .of_base;
  const elastic::ElasticBody body = elastic::elastic_body(base);
  const auto ratio = [&](double radius) {
    double of_means = 0, of_nodes = 0;
    const std::vector<elastic::StaticLoad> loads =
        elastic::pushes(base, {.count = 20, .radius = radius});
    const std::vector<elastic::StaticSolution> solved = elastic::solve_static(body, loads);
    for (std::size_t l = 0; l < loads.size(); ++l) {
      of_means += work_on_means(loads[l].force, solved[l].displacement, base.mass, groups);
      of_nodes += solved[l].compliance;
    }
    return of_means / of_nodes;
  };
  CHECK(ratio(0.5) < 0.7);  // single nodes
  CHECK(ratio(3) > 0.85);
  CHECK(ratio(3) < 1);
}
