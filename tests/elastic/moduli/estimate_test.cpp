#include <catch2/catch.hpp>

#include "elastic/moduli.hpp"
#include "tests/support/models.hpp"

namespace springlod::elastic {
namespace {

TEST_CASE("Eq. 2 for a rod of three nodes agrees with a calculation by hand") {
  // k L^2 = 100 and 60 * 4; volumes 1, 3 and 2 litres.
  MassSpringModel m =
      test::table_model({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}, {1, 3, 2}, {{0, 1, 100}, {1, 2, 60}});
  m.materials.push_back(Material{.name = "end"});
  m.materials.push_back(Material{.name = "none"});
  m.material = {0, 0, 1};
  const ModelEstimate e = estimate(m);
  CHECK(e.young[0] == Approx(50 / (6 * 1e-3)));
  CHECK(e.young[1] == Approx(170 / (6 * 3e-3)));
  CHECK(e.young[2] == Approx(120 / (6 * 2e-3)));
  CHECK(e.density[1] == Approx(1000));
  CHECK(e.whole.young == Approx(estimated_young(m)));
  CHECK(e.whole.work == Approx(spring_work(m)));
  CHECK(e.whole.shear == Approx(340 / (15 * 6e-3)));
  CHECK(e.whole.bulk == Approx(340 / (9 * 6e-3)));
  CHECK(e.materials[0].nodes == 2);
  CHECK(e.materials[0].young == Approx(220 / (6 * 4e-3)));
  CHECK(e.materials[1].mass == 2);
  CHECK(e.materials[2].nodes == 0);
  CHECK(e.materials[2].young == 0);
}

TEST_CASE("The estimates of the materials add up to that of the whole model") {
  const MassSpringModel m = test::random_model(4);
  const ModelEstimate e = estimate(m);
  double work = 0;
  double volume = 0;
  for (const Eq2Estimate& material : e.materials) {
    work += material.work;
    volume += material.volume;
  }
  CHECK(work == Approx(e.whole.work));
  CHECK(volume == Approx(e.whole.volume));
  double of_nodes = 0;
  for (std::uint32_t i = 0; i < m.node_count(); ++i) of_nodes += e.young[i] * m.volume[i];
  CHECK(of_nodes == Approx(e.whole.young * volume));
}

}  // namespace
}  // namespace springlod::elastic
