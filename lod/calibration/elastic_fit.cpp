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
  constexpr double kLow = 4.5, kHigh = 1.25;
  return mode < kLowestModes ? kLow : kHigh;
}

/// Weight of the compliance of a pair of modal loads, relative to that of a smooth load. A pair of
/// different modes counts once here and twice in the matrix of all pairs; with half of its square
/// for a load with itself, the sum of squares within modes of equal frequency is that of the
/// matrix, which does not depend on their basis.
constexpr double kShape = 3;

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
                       const ElasticTargets& targets, const FitOptions& options)
    : targets_(targets),
      threads_(options.threads),
      free_masses_(options.masses == NodeMasses::free),
      anchored_(mapped_nodes(of_base, targets.anchored)),
      modal_(modal_loads(level, of_base, targets, anchored_)),
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
  const auto of_loads = static_cast<Eigen::Index>(loads_.size());
  const auto shapes = static_cast<Eigen::Index>(modal_.loads.size());
  const Eigen::Index rows = of_modes + of_loads + shapes * (shapes + 1) / 2;
  const Eigen::Index masses = free_masses_ ? level.node_count() : 0;
  ElasticResiduals all;
  all.weighted = Eigen::VectorXd::Zero(rows);
  all.jacobian = Eigen::MatrixXd::Zero(level.spring_count() + masses, rows);
  run_jobs(2, threads_, [&](std::uint64_t job, const std::function<bool()>&) {
    if (job == 0 && of_modes > 0) add_modes(level, body, 0, all);
    if (job == 0 && shapes > 0) add_shapes(level, body, of_modes + of_loads, all);
    if (job == 1 && of_loads > 0) add_loads(level, body, of_modes, all);
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
    all.jacobian.col(row).head(k.size()) =
        weight / scale * k * stretch[i].array() * stretch[j].array();
    if (free_masses_)
      all.jacobian.col(row).tail(m.size()) =
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
    all.jacobian.col(row).head(k.size()) = -target.weight / c * k * stretch.array().square();
    if (free_masses_)
      all.jacobian.col(row).tail(m.size()) =
          -2 * target.weight / c * m *
          dots(solved[l].displacement, rigid_acceleration(body, loads_[l])).array();
    all.weighted[row] = target.weight * std::log(target.compliance / c);
  }
}

void ElasticFit::add_shapes(const MassSpringModel& level, const elastic::ElasticBody& body,
                            Eigen::Index first, ElasticResiduals& all) const {
  const std::vector<elastic::StaticSolution> solved = elastic::solve_static(
      body, modal_.loads, {.relative_tolerance = kLoadBalance, .balance_free_motions = true});
  std::vector<Eigen::VectorXd> stretch;
  std::vector<std::vector<Vec3>> acceleration;
  for (std::size_t i = 0; i < solved.size(); ++i) {
    stretch.emplace_back(stretch_ * flat(solved[i].displacement));
    if (free_masses_) acceleration.push_back(rigid_acceleration(body, modal_.loads[i]));
  }
  const auto k = as_vector(level.stiffness).array();
  const auto m = as_vector(level.mass).array();
  Eigen::Index row = first;
  for (std::size_t i = 0; i < solved.size(); ++i)
    for (std::size_t j = i; j < solved.size(); ++j) {
      // The compliance of the lower mode is the unit: two modes that mix by an angle then have a
      // residual of about that angle, however far apart their frequencies are.
      const double weight = targets_.shape_weight * (i == j ? kShape * std::sqrt(0.5) : kShape) *
                            targets_.squared_frequency[i];
      const double compliance = flat(modal_.loads[j].force).dot(flat(solved[i].displacement));
      all.jacobian.col(row).head(k.size()) = -weight * k * stretch[i].array() * stretch[j].array();
      if (free_masses_)
        all.jacobian.col(row).tail(m.size()) = -weight * m *
                                               (dots(solved[i].displacement, acceleration[j]) +
                                                dots(solved[j].displacement, acceleration[i]))
                                                   .array();
      all.weighted[row] =
          weight * (modal_.compliance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) -
                    compliance);
      ++row;
    }
}

}  // namespace springlod::lod
