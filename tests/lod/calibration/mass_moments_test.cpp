#include "lod/calibration/mass_moments.hpp"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "tests/support/bodies.hpp"

using namespace springlod;
using namespace springlod::lod;

namespace {

using Moments = Eigen::Matrix<double, 10, 1>;

// Moments of the nodes of one material, or of all nodes if it is -1.
Moments moments(const MassSpringModel& model, const std::vector<double>& mass, int material) {
  Moments sum = Moments::Zero();
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    if (material >= 0 && model.material[i] != static_cast<std::uint32_t>(material)) continue;
    const Vec3& x = model.rest[i];
    Moments m;
    m << 1, x, x.cwiseAbs2(), x.x() * x.y(), x.x() * x.z(), x.y() * x.z();
    sum += mass[i] * m;
  }
  return sum;
}

double largest_part(const Moments& change, const Moments& of) {
  return change.cwiseAbs().maxCoeff() / of.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("MassMoments keeps the moments of the body or of each material region") {
  const MassSpringModel model = test::rods();
  REQUIRE(model.materials.size() == 2);
  const KeptMoments kept = GENERATE(KeptMoments::body, KeptMoments::pieces);
  const MassMoments keeper(model, kept);
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<double> mass = model.mass;
  for (double& m : mass) m *= std::exp(0.2 * normal(random));
  keeper.restore(mass);
  const bool of_pieces = kept == KeptMoments::pieces;
  const std::vector<int> kept_of = of_pieces ? std::vector<int>{-1, 0, 1} : std::vector<int>{-1};
  for (const int material : kept_of) {
    const Moments wanted = moments(model, model.mass, material);
    CHECK(largest_part(moments(model, mass, material) - wanted, wanted) < 1e-12);
  }
  if (!of_pieces) {
    const Moments of_one = moments(model, model.mass, 0);
    CHECK(largest_part(moments(model, mass, 0) - of_one, of_one) > 1e-3);
  }

  Eigen::MatrixXd changes(model.node_count(), 3);
  for (double& c : changes.reshaped()) c = normal(random);
  const Eigen::MatrixXd asked = changes;
  keeper.project(model.mass, changes);
  CHECK(changes.norm() > 0.5 * asked.norm());
  for (const int material : kept_of)
    for (Eigen::Index column = 0; column < changes.cols(); ++column) {
      std::vector<double> shift(model.node_count());
      for (std::size_t i = 0; i < shift.size(); ++i)
        shift[i] = model.mass[i] * changes(static_cast<Eigen::Index>(i), column);
      CHECK(largest_part(moments(model, shift, material), moments(model, model.mass, material)) <
            1e-12);
    }
}
