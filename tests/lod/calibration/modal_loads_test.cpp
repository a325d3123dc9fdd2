// Mode shapes as targets of a calibration.

#include "lod/calibration/modal_loads.hpp"

#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include <catch2/catch.hpp>

#include "elastic/elastic_body.hpp"
#include "elastic/modes.hpp"
#include "lod/build.hpp"
#include "lod/calibration/elastic_fit.hpp"
#include "lod/group_means.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/models.hpp"

using namespace springlod;
using namespace springlod::lod;
using springlod::test::block;

namespace {

constexpr std::uint32_t kModes = 6;

ElasticTargets targets_of(const MassSpringModel& base, std::vector<std::uint32_t> anchored = {}) {
  return measure_targets(base, identity_groups(base.node_count()),
                         {.kinds = TargetKinds::modes, .modes = kModes, .anchored = anchored});
}

Level level_of(const MassSpringModel& base) {
  return simplify(base, {.levels = 1, .keep = {0.4}, .grouping = {.grouping = Grouping::compact}})
      .levels[1];
}

/// f_j . u_i of the level's modal loads.
Eigen::MatrixXd measured_compliance(const MassSpringModel& level, const ModalLoads& modal) {
  const std::vector<elastic::StaticSolution> solved = elastic::solve_static(
      elastic::elastic_body(level), modal.loads, {.balance_free_motions = true});
  const auto modes = static_cast<Eigen::Index>(solved.size());
  Eigen::MatrixXd compliance = Eigen::MatrixXd::Zero(modes, modes);
  for (Eigen::Index i = 0; i < modes; ++i)
    for (Eigen::Index j = 0; j < modes; ++j)
      for (std::uint32_t node = 0; node < level.node_count(); ++node)
        compliance(i, j) += modal.loads[static_cast<std::size_t>(j)].force[node].dot(
            solved[static_cast<std::size_t>(i)].displacement[node]);
  return compliance;
}

/// Largest entry of D A D with D = diag(omega): errors relative to 1 / omega^2.
double largest_entry(const Eigen::MatrixXd& a, const ElasticTargets& targets) {
  const Eigen::ArrayXd omega =
      Eigen::Map<const Eigen::ArrayXd>(targets.squared_frequency.data(), a.rows()).sqrt();
  return (omega.matrix().asDiagonal() * a * omega.matrix().asDiagonal()).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("The modal compliances of a level equal to its base are 1 / omega^2 on the diagonal") {
  // Unequal edges: no multiple frequencies. The shapes of the solver are accurate to about 1e-4.
  const MassSpringModel base = block(3, 4, 6);
  const ElasticTargets targets = targets_of(base);
  Groups same{std::vector<std::uint32_t>(base.node_count()), base.node_count()};
  std::iota(same.of.begin(), same.of.end(), 0U);
  const ModalLoads modal = modal_loads(base, same, targets, {});
  Eigen::MatrixXd wanted = Eigen::MatrixXd::Zero(kModes, kModes);
  for (Eigen::Index i = 0; i < kModes; ++i)
    wanted(i, i) = 1 / targets.squared_frequency[static_cast<std::size_t>(i)];
  CHECK(largest_entry(modal.compliance - wanted, targets) < 1e-3);
  CHECK(largest_entry(measured_compliance(base, modal) - wanted, targets) < 1e-3);
  const ElasticResiduals residuals = ElasticFit(base, same, targets).residuals(base);
  CHECK(residuals.weighted.cwiseAbs().maxCoeff() < 1e-3);

  MassSpringModel softer = base;
  for (double& k : softer.stiffness) k *= 0.9;
  const Eigen::VectorXd of_softer = ElasticFit(base, same, targets).residuals(softer).weighted;
  // On the diagonal C / C0 - 1 = 1 / 0.9 - 1, with the weight 3 sqrt(0.5).
  CHECK(of_softer[kModes] == Approx(-3 * std::sqrt(0.5) * (1 / 0.9 - 1)).epsilon(1e-2));
}

TEST_CASE("A modal load has the group mean of the mode as its reference displacement") {
  const MassSpringModel base = block(3, 4, 6);
  const Level level = level_of(base);
  const ElasticTargets targets = targets_of(base);
  const ModalLoads modal = modal_loads(level.model, level.of_base, targets, {});
  REQUIRE(modal.loads.size() == kModes);
  const std::vector<elastic::Mode> modes = elastic::lowest_modes(base, {.count = kModes}).modes;
  std::vector<std::vector<Vec3>> means;
  for (const elastic::Mode& mode : modes)
    means.push_back(group_means(mode.shape, base.mass, level.of_base));
  for (std::size_t i = 0; i < kModes; ++i)
    for (std::size_t j = 0; j < kModes; ++j) {
      double product = 0;
      for (std::uint32_t node = 0; node < level.model.node_count(); ++node) {
        product += modal.loads[j].force[node].dot(means[i][node]);
        if (i == j)
          CHECK((modal.loads[j].force[node] - level.model.mass[node] * means[j][node]).norm() <
                1e-12);
      }
      const double inverse =
          0.5 * (1 / targets.squared_frequency[i] + 1 / targets.squared_frequency[j]);
      CHECK(modal.compliance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) ==
            Approx(inverse * product).margin(1e-12 * inverse));
    }
  const Eigen::MatrixXd found = measured_compliance(level.model, modal);
  CHECK(largest_entry(found - found.transpose(), targets) < 1e-9);
  CHECK(largest_entry(found - modal.compliance, targets) > 0.01);  // merging changed the shapes
}

TEST_CASE("Modal loads do not act on held nodes") {
  const MassSpringModel base = block(3, 4, 6);
  const Level level = level_of(base);
  const std::vector<std::uint32_t> anchored{0, 1, 2, 3};
  const ElasticTargets targets = targets_of(base, anchored);
  const std::vector<std::uint32_t> held = mapped_nodes(level.of_base, anchored);
  const ModalLoads modal = modal_loads(level.model, level.of_base, targets, held);
  REQUIRE(modal.loads.size() == kModes);
  for (const elastic::StaticLoad& load : modal.loads)
    for (const std::uint32_t node : held) CHECK(load.force[node] == Vec3::Zero());
}

TEST_CASE("A weight of 0 leaves the shapes out of the targets") {
  const MassSpringModel base = block(3, 4, 6);
  const Groups alone = identity_groups(base.node_count());
  const ElasticTargets targets =
      measure_targets(base, alone, {.modes = kModes, .patches = 4, .shape_weight = 0});
  CHECK(targets.modal_forces.empty());
  CHECK_THROWS_WITH(measure_targets(base, alone, {.shape_weight = -1}),
                    Catch::Contains("shape_weight = -1 must be 0 or more"));
}
