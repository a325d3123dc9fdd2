#include "lod/calibration/elastic_fit.hpp"

#include <cmath>
#include <functional>

#include "base/parallel.hpp"
#include "elastic/modes.hpp"
#include "lod/calibration/tolerance.hpp"

namespace springlod::lod {
namespace {

/// Squared frequencies of the base count as equal within this fraction.
constexpr double kSameFrequency = 0.01;
/// Relative error bound of the squared frequencies; the error itself is about its square.
constexpr double kAccuracy = 1e-3;

/// Weight of a mode, relative to that of a smooth load. The ten lowest modes carry most of a
/// motion. With these weights each kind of residual counts about equally at its tolerance.
double mode_weight(std::size_t mode) {
  constexpr double kLow = 3.75, kHigh = 1;
  return mode < kLowestModes ? kLow : kHigh;
}

auto flat(const std::vector<Vec3>& vectors) {
  return Eigen::Map<const Eigen::VectorXd>(vectors.front().data(),
                                           3 * static_cast<Eigen::Index>(vectors.size()));
}

auto as_vector(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(),
                                           static_cast<Eigen::Index>(numbers.size()));
}

/// x_i . y_i of each node.
Eigen::VectorXd dots(const std::vector<Vec3>& x, const std::vector<Vec3>& y) {
  Eigen::VectorXd dot(static_cast<Eigen::Index>(x.size()));
  for (std::size_t i = 0; i < x.size(); ++i) dot[static_cast<Eigen::Index>(i)] = x[i].dot(y[i]);
  return dot;
}

/// Acceleration of the nodes of the undeformed body under the load [m/s2].
std::vector<Vec3> rigid_acceleration(const elastic::ElasticBody& body,
                                     const elastic::StaticLoad& load) {
  std::vector<Vec3> acceleration(body.node_count, Vec3::Zero());
  for (const elastic::ElasticComponent& part : body.components) {
    const Eigen::VectorXd force = part.gather(load.force).cwiseQuotient(part.root_mass);
    const Eigen::VectorXd rigid = part.zero_modes * (part.zero_modes.transpose() * force);
    part.scatter(rigid.cwiseQuotient(part.root_mass), acceleration);
  }
  return acceleration;
}

}  // namespace

ElasticFit::ElasticFit(const MassSpringModel& level, const Groups& of_base,
                       const ElasticTargets& targets, std::uint32_t threads)
    : targets_(targets),
      threads_(threads),
      anchored_(mapped_nodes(of_base, targets.anchored)),
      stretch_(level.spring_count(), 3 * static_cast<Eigen::Index>(level.node_count())) {
  for (const LoadTarget& target : targets.loads)
    loads_.push_back(summed_over_groups(of_base, target.load));
  std::vector<Eigen::Triplet<double>> entries;
  for (std::uint32_t s = 0; s < level.spring_count(); ++s) {
    const Vec3 u = spring_direction(level, s);
    for (int d = 0; d < 3; ++d) {
      entries.emplace_back(s, 3 * level.a[s] + d, -u[d]);
      entries.emplace_back(s, 3 * level.b[s] + d, u[d]);
    }
  }
  stretch_.setFromTriplets(entries.begin(), entries.end());
}

std::vector<std::pair<std::size_t, std::size_t>> ElasticFit::mode_pairs() const {
  const std::vector<double>& wanted = targets_.squared_frequency;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    for (std::size_t j = i; j < wanted.size(); ++j) {
      if (j > i && wanted[j] > (1 + kSameFrequency) * wanted[j - 1]) break;
      pairs.emplace_back(i, j);
    }
  return pairs;
}

ElasticResiduals ElasticFit::residuals(const MassSpringModel& level) const {
  const elastic::ElasticBody body = elastic::elastic_body(level, {.anchored = anchored_});
  const auto of_modes = static_cast<Eigen::Index>(mode_pairs().size());
  const Eigen::Index rows = of_modes + static_cast<Eigen::Index>(loads_.size());
  ElasticResiduals all;
  all.weighted = Eigen::VectorXd::Zero(rows);
  all.jacobian = Eigen::MatrixXd::Zero(level.spring_count() + level.node_count(), rows);
  run_jobs(2, threads_, [&](std::uint64_t job, const std::function<bool()>&) {
    if (job == 0 && of_modes > 0) add_modes(level, body, 0, all);
    if (job == 1 && !loads_.empty()) add_loads(level, body, of_modes, all);
  });
  return all;
}

void ElasticFit::add_modes(const MassSpringModel& level, const elastic::ElasticBody& body,
                           Eigen::Index first, ElasticResiduals& all) const {
  const std::vector<double>& wanted = targets_.squared_frequency;
  const std::vector<elastic::Mode> found =
      elastic::lowest_modes(
          body, {.count = static_cast<std::uint32_t>(wanted.size()), .accuracy = kAccuracy})
          .modes;
  std::vector<Eigen::VectorXd> stretch;
  for (std::size_t i = 0; i < found.size(); ++i) {
    stretch.emplace_back(stretch_ * flat(found[i].shape));
    all.frequency_error.push_back(std::abs(found[i].angular_frequency / std::sqrt(wanted[i]) - 1));
  }
  const auto k = as_vector(level.stiffness).array();
  const auto m = as_vector(level.mass).array();
  Eigen::Index row = first;
  for (const auto& [i, j] : mode_pairs()) {
    if (j >= found.size()) break;  // a level of very few nodes has fewer modes
    const double scale = found[i].angular_frequency * found[j].angular_frequency;
    const double weight = targets_.mode_weight * mode_weight(i);
    all.jacobian.col(row) << weight / scale * k * stretch[i].array() * stretch[j].array(),
        -weight * m * dots(found[i].shape, found[j].shape).array();
    if (i == j) all.weighted[row] = weight * std::log(wanted[i] / scale);
    ++row;
  }
}

void ElasticFit::add_loads(const MassSpringModel& level, const elastic::ElasticBody& body,
                           Eigen::Index first, ElasticResiduals& all) const {
  const std::vector<elastic::StaticSolution> solved = elastic::solve_static(
      body, loads_, {.relative_tolerance = kLoadBalance, .balance_free_motions = true});
  const auto k = as_vector(level.stiffness).array();
  const auto m = as_vector(level.mass).array();
  for (std::size_t l = 0; l < loads_.size(); ++l) {
    const LoadTarget& target = targets_.loads[l];
    const double c = solved[l].compliance;
    all.compliance_error.push_back(std::abs(c / target.compliance - 1));
    if (!(c > 0)) continue;  // the forces cancel within the groups
    const Eigen::VectorXd stretch = stretch_ * flat(solved[l].displacement);
    const Eigen::Index row = first + static_cast<Eigen::Index>(l);
    all.jacobian.col(row) << -target.weight / c * k * stretch.array().square(),
        -2 * target.weight / c * m *
            dots(solved[l].displacement, rigid_acceleration(body, loads_[l])).array();
    all.weighted[row] = target.weight * std::log(target.compliance / c);
  }
}

}  // namespace springlod::lod
