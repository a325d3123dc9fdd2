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

/// k of each spring [N/m], then T of each dilatation term [J].
Eigen::ArrayXd moduli_of(const MassSpringModel& level) {
  Eigen::ArrayXd moduli(level.spring_count() + level.dilatation.count());
  moduli.head(level.spring_count()) = as_vector(level.stiffness).array();
  moduli.tail(level.dilatation.count()) = as_vector(level.dilatation.modulus).array();
  return moduli;
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
      anchored_(mapped_support(of_base, targets.anchored)),
      modal_(modal_loads(level, of_base, targets, anchored_.nodes)),
      stretch_(level.spring_count() + level.dilatation.count(),
               3 * static_cast<Eigen::Index>(level.node_count())) {
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
  const DilatationTerms& terms = level.dilatation;
  for (std::uint32_t t = 0; t < terms.count(); ++t)
    for (std::uint32_t e = terms.start[t]; e < terms.start[t + 1]; ++e)
      for (int d = 0; d < 3; ++d)
        entries.emplace_back(level.spring_count() + t, 3 * terms.node[e] + d, terms.gradient[e][d]);
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

ElasticFit::Rows ElasticFit::rows() const {
  const auto shapes = static_cast<Eigen::Index>(modal_.loads.size());
  Rows rows;
  rows.loads = static_cast<Eigen::Index>(mode_pairs().size());
  rows.shapes = rows.loads + static_cast<Eigen::Index>(loads_.size());
  rows.end = rows.shapes + shapes * (shapes + 1) / 2;
  return rows;
}

ElasticResiduals ElasticFit::residuals(const MassSpringModel& level) const {
  const elastic::ElasticBody body = elastic::elastic_body(level, {.anchored = anchored_});
  ElasticResiduals all;
  all.weighted = Eigen::VectorXd::Zero(rows().end);
  run_jobs(2, threads_, [&](std::uint64_t job, const std::function<bool()>&) {
    if (job == 0 && !targets_.squared_frequency.empty()) solve_modes(body, all);
    if (job == 0 && !modal_.loads.empty()) solve_shapes(body, all);
    if (job == 1 && !loads_.empty()) solve_loads(body, all);
  });
  return all;
}

void ElasticFit::jacobian(const MassSpringModel& level, const ElasticResiduals& of_level,
                          Eigen::MatrixXd& into) const {
  into.resize(stretch_.rows() + (free_masses_ ? level.node_count() : 0), rows().end);
  run_jobs(2, threads_, [&](std::uint64_t job, const std::function<bool()>&) {
    if (job == 0) add_modes(level, of_level, into);
    if (job == 0) add_shapes(level, of_level, into);
    if (job == 1) add_loads(level, of_level, into);
  });
}

void ElasticFit::solve_modes(const elastic::ElasticBody& body, ElasticResiduals& all) const {
  const std::vector<double>& wanted = targets_.squared_frequency;
  const auto count = static_cast<std::uint32_t>(wanted.size());
  all.modes = elastic::lowest_modes(body, {.count = count, .start = modal_.shapes}).modes;
  for (std::size_t i = 0; i < all.modes.size(); ++i)
    all.frequency_error.push_back(
        std::abs(all.modes[i].angular_frequency / std::sqrt(wanted[i]) - 1));
  Eigen::Index row = 0;
  for (const auto& [i, j] : mode_pairs()) {
    if (i == j && i < all.modes.size())  // a level of very few nodes has fewer modes
      all.weighted[row] =
          targets_.mode_weight * mode_weight(i) *
          std::log(wanted[i] / (all.modes[i].angular_frequency * all.modes[i].angular_frequency));
    ++row;
  }
}

void ElasticFit::add_modes(const MassSpringModel& level, const ElasticResiduals& of_level,
                           Eigen::MatrixXd& into) const {
  const std::vector<elastic::Mode>& found = of_level.modes;
  std::vector<Eigen::VectorXd> stretch;
  for (const elastic::Mode& mode : found) stretch.emplace_back(stretch_ * flat(mode.shape));
  const Eigen::ArrayXd k = moduli_of(level);
  const auto m = as_vector(level.mass).array();
  Eigen::Index row = 0;
  for (const auto& [i, j] : mode_pairs()) {
    auto column = into.col(row++);
    if (j >= found.size()) {
      column.setZero();
      continue;
    }
    const double scale = found[i].angular_frequency * found[j].angular_frequency;
    const double weight = targets_.mode_weight * mode_weight(i);
    column.head(k.size()) = weight / scale * k * stretch[i].array() * stretch[j].array();
    if (free_masses_)
      column.tail(m.size()) = -weight * m * dots(found[i].shape, found[j].shape).array();
  }
}

void ElasticFit::solve_loads(const elastic::ElasticBody& body, ElasticResiduals& all) const {
  all.loads = elastic::solve_static(
      body, loads_, {.relative_tolerance = kLoadBalance, .balance_free_motions = true});
  for (std::size_t l = 0; l < loads_.size(); ++l) {
    const LoadTarget& target = targets_.loads[l];
    const double c = all.loads[l].compliance;
    all.compliance_error.push_back(std::abs(c / target.compliance - 1));
    if (free_masses_) all.load_acceleration.push_back(rigid_acceleration(body, loads_[l]));
    if (c > 0)  // otherwise the forces cancel within the groups
      all.weighted[rows().loads + static_cast<Eigen::Index>(l)] =
          target.weight * std::log(target.compliance / c);
  }
}

void ElasticFit::add_loads(const MassSpringModel& level, const ElasticResiduals& of_level,
                           Eigen::MatrixXd& into) const {
  const Eigen::ArrayXd k = moduli_of(level);
  const auto m = as_vector(level.mass).array();
  for (std::size_t l = 0; l < loads_.size(); ++l) {
    auto column = into.col(rows().loads + static_cast<Eigen::Index>(l));
    const elastic::StaticSolution& solved = of_level.loads[l];
    const double c = solved.compliance;
    const double weight = targets_.loads[l].weight;
    if (!(c > 0)) {
      column.setZero();
      continue;
    }
    const Eigen::VectorXd stretch = stretch_ * flat(solved.displacement);
    column.head(k.size()) = -weight / c * k * stretch.array().square();
    if (free_masses_)
      column.tail(m.size()) =
          -2 * weight / c * m * dots(solved.displacement, of_level.load_acceleration[l]).array();
  }
}

// The compliance of the lower mode is the unit: two modes that mix by an angle then have a residual
// of about that angle, however far apart their frequencies are.
double ElasticFit::shape_weight(std::size_t i, std::size_t j) const {
  return targets_.shape_weight * (i == j ? kShape * std::sqrt(0.5) : kShape) *
         targets_.squared_frequency[i];
}

void ElasticFit::solve_shapes(const elastic::ElasticBody& body, ElasticResiduals& all) const {
  all.shapes = elastic::solve_static(
      body, modal_.loads, {.relative_tolerance = kLoadBalance, .balance_free_motions = true});
  Eigen::Index row = rows().shapes;
  for (std::size_t i = 0; i < all.shapes.size(); ++i) {
    if (free_masses_) all.shape_acceleration.push_back(rigid_acceleration(body, modal_.loads[i]));
    for (std::size_t j = i; j < all.shapes.size(); ++j) {
      const double compliance = flat(modal_.loads[j].force).dot(flat(all.shapes[i].displacement));
      all.weighted[row++] = shape_weight(i, j) * (modal_.compliance(static_cast<Eigen::Index>(i),
                                                                    static_cast<Eigen::Index>(j)) -
                                                  compliance);
    }
  }
}

void ElasticFit::add_shapes(const MassSpringModel& level, const ElasticResiduals& of_level,
                            Eigen::MatrixXd& into) const {
  const std::vector<elastic::StaticSolution>& solved = of_level.shapes;
  const std::vector<std::vector<Vec3>>& acceleration = of_level.shape_acceleration;
  std::vector<Eigen::VectorXd> stretch;
  for (const elastic::StaticSolution& one : solved)
    stretch.emplace_back(stretch_ * flat(one.displacement));
  const Eigen::ArrayXd k = moduli_of(level);
  const auto m = as_vector(level.mass).array();
  Eigen::Index row = rows().shapes;
  for (std::size_t i = 0; i < solved.size(); ++i)
    for (std::size_t j = i; j < solved.size(); ++j) {
      const double weight = shape_weight(i, j);
      auto column = into.col(row++);
      column.head(k.size()) = -weight * k * stretch[i].array() * stretch[j].array();
      if (free_masses_)
        column.tail(m.size()) = -weight * m *
                                (dots(solved[i].displacement, acceleration[j]) +
                                 dots(solved[j].displacement, acceleration[i]))
                                    .array();
    }
}

}  // namespace springlod::lod
