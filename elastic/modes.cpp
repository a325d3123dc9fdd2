#include "elastic/modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"
#include "elastic/solver/dense_kernels.hpp"
#include "elastic/solver/random_block.hpp"

namespace springlod::elastic {
namespace {

/// Vectors that are iterated together: as many copies of a frequency are found for sure, and
/// solving for 8 at once costs little more than twice one.
constexpr Eigen::Index kBlock = 8;
/// Up to so many unknowns a dense eigenvalue solver is quicker than iterating.
constexpr Eigen::Index kDenseUnknowns = 240;
/// Where the iteration runs out of room the dense solver takes over up to here (a minute).
constexpr Eigen::Index kMostDenseUnknowns = 4000;
/// Eigenvalues over the shift that rounding in the matrix still leaves something of.
constexpr double kLeastOfShift = 1e-3;

/// Modes of one part in its mass-weighted unknowns.
struct PartSpectrum {
  Eigen::VectorXd squared_frequency;  // rising
  Eigen::VectorXd residual;
  Eigen::MatrixXd shapes;  // orthonormal columns
};

/// All of the spectrum but the zero modes, up to `count`.
PartSpectrum solve_dense(const ElasticPart& part, Eigen::Index count) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver{Eigen::MatrixXd(part.stiffness)};
  const Eigen::Index zeros = part.zero_modes.cols();
  const Eigen::Index found = std::min(count, part.unknowns() - zeros);
  PartSpectrum spectrum;
  spectrum.squared_frequency = solver.eigenvalues().segment(zeros, found).cwiseMax(0);
  spectrum.shapes = solver.eigenvectors().middleCols(zeros, found);
  const Eigen::MatrixXd rest =
      part.stiffness * spectrum.shapes - spectrum.shapes * spectrum.squared_frequency.asDiagonal();
  spectrum.residual = rest.colwise().norm().transpose().cwiseQuotient(spectrum.squared_frequency);
  return spectrum;
}

/// Block Lanczos for the largest eigenvalues theta = 1 / (lambda + sigma), every vector made
/// orthogonal to all before it.
class BlockLanczos {
 public:
  BlockLanczos(const ElasticPart& part, Eigen::Index count, const ModeOptions& options)
      : part_(part),
        count_(count),
        accuracy_(options.accuracy),
        // Most bodies need two to five vectors a mode.
        most_vectors_(std::min(8 * count + 300, part.unknowns() - part.zero_modes.cols() - kBlock)),
        task_(options.progress, "iterating for modes", static_cast<std::uint64_t>(count)),
        next_look_(count) {
    next_ = random_block(part.unknowns(), kBlock, options.seed);
    part_.remove_zero_modes(next_);
    orthonormalise(next_);
  }

  /// None if there is no room left for more vectors.
  std::optional<PartSpectrum> run() {
    while (vectors_ + kBlock <= most_vectors_) {
      expand();
      task_.advance(0);  // lets the user interrupt
      if (vectors_ >= next_look_ && converged()) return spectrum();
    }
    return std::nullopt;
  }

 private:
  /// Splits `block` into orthonormal columns, which it becomes, and what they are multiplied by.
  static Eigen::MatrixXd orthonormalise(Eigen::MatrixXd& block) {
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(block);
    const Eigen::Index columns = block.cols();
    Eigen::MatrixXd factor =
        qr.matrixQR().topRows(columns).triangularView<Eigen::Upper>().toDenseMatrix();
    block.setIdentity();
    block = qr.householderQ() * block;
    return factor;
  }

  void expand() {
    if (basis_.cols() < vectors_ + kBlock) {  // grow by half: copying stays cheap
      const Eigen::Index room = std::max(vectors_ + kBlock, basis_.cols() * 3 / 2);
      basis_.conservativeResize(part_.unknowns(), room);
    }
    basis_.middleCols(vectors_, kBlock) = next_;
    vectors_ += kBlock;
    const auto basis = basis_.leftCols(vectors_);

    next_ = part_.solve_shifted(next_);
    Eigen::MatrixXd along = transposed_product(basis, next_);
    subtract_product(basis, along, next_);
    const Eigen::MatrixXd again = transposed_product(basis, next_);  // what rounding left
    subtract_product(basis, again, next_);
    along += again;
    projected_.conservativeResize(vectors_, vectors_);
    projected_.bottomRows(kBlock) = along.transpose();  // the solver reads the lower half alone
    coupling_ = orthonormalise(next_);
    // Where the space is exhausted (bodies with many equal frequencies) that made vectors of mere
    // rounding; they are as good a new start as any once they are orthogonal.
    subtract_product(basis, transposed_product(basis, next_), next_);
    part_.remove_zero_modes(next_);
    coupling_ = orthonormalise(next_) * coupling_;
  }

  bool converged() {
    // Looking costs the cube of the vectors: do so when there are a tenth more.
    next_look_ = vectors_ + vectors_ / 10;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(projected_);
    theta_ = solver.eigenvalues().tail(count_).reverse();
    ritz_ = solver.eigenvectors().rightCols(count_).rowwise().reverse();
    const Eigen::VectorXd rest =
        (coupling_ * ritz_.bottomRows(kBlock)).colwise().norm().transpose();
    // What theta misses by counts for more in a lambda that is smaller than sigma.
    const Eigen::VectorXd amplified =
        (1 - part_.shift * theta_.array()).max(kLeastOfShift).inverse();
    residual_ = rest.cwiseQuotient(theta_).cwiseProduct(amplified);
    const auto done = (residual_.array() <= accuracy_).count();
    if (done > reported_) task_.advance(static_cast<std::uint64_t>(done - reported_));
    reported_ = std::max(reported_, done);
    return done == count_;
  }

  PartSpectrum spectrum() const {
    PartSpectrum spectrum;
    spectrum.squared_frequency = (theta_.cwiseInverse().array() - part_.shift).max(0.0);
    spectrum.residual = residual_;
    // One more product damps what is left of high frequencies, which weigh much in strains.
    spectrum.shapes = part_.solve_shifted(basis_.leftCols(vectors_) * ritz_);
    spectrum.shapes.colwise().normalize();
    return spectrum;
  }

  const ElasticPart& part_;
  Eigen::Index count_;
  double accuracy_;
  Eigen::Index most_vectors_;
  Task task_;
  Eigen::Index next_look_;
  Eigen::Index vectors_ = 0;
  Eigen::Index reported_ = 0;
  Eigen::MatrixXd basis_;      // orthonormal, the first vectors_ columns
  Eigen::MatrixXd next_;       // the next block of it
  Eigen::MatrixXd projected_;  // basis^T (D + sigma)^-1 basis, lower half
  Eigen::MatrixXd coupling_;   // of the last block to the next
  Eigen::VectorXd theta_, residual_;
  Eigen::MatrixXd ritz_;
};

/// Iterating on what is not a number neither converges nor fails until all room is used up.
void require_finite(const ElasticPart& part) {
  const Eigen::Map<const Eigen::VectorXd> entries(part.stiffness.valuePtr(),
                                                  part.stiffness.nonZeros());
  if (!entries.allFinite())
    throw InputError(fmt::format(
        "modes: the stiffness over the masses of the part at node {} "
        "is not finite; look for springs that are far too stiff or masses far too small",
        script_number(part.nodes.front())));
}

PartSpectrum solve(const ElasticPart& part, const ModeOptions& options) {
  require_finite(part);
  const Eigen::Index there = part.unknowns() - part.zero_modes.cols();
  const auto count = std::min(static_cast<Eigen::Index>(options.count), there);
  if (part.unknowns() > kDenseUnknowns)
    if (auto spectrum = BlockLanczos(part, count, options).run()) return *std::move(spectrum);
  if (part.unknowns() > kMostDenseUnknowns)
    throw InputError(
        fmt::format("modes: not converged for {} modes of {} nodes; ask for fewer, or "
                    "for less accuracy than {}",
                    count, part.nodes.size(), options.accuracy));
  return solve_dense(part, count);
}

void check(const ModeOptions& options) {
  if (options.count == 0) throw InputError("modes: count must be 1 or more");
  constexpr double kFinest = 1e-12, kCoarsest = 0.1;
  if (!(options.accuracy >= kFinest && options.accuracy <= kCoarsest))
    throw InputError(fmt::format("modes: accuracy {} must be between {} and {}", options.accuracy,
                                 kFinest, kCoarsest));
}

}  // namespace

double Mode::frequency() const {
  return angular_frequency / (2 * std::numbers::pi);
}

Modes lowest_modes(const ElasticBody& body, const ModeOptions& options) {
  check(options);
  struct Found {
    double squared_frequency;
    std::size_t part;
    Eigen::Index column;
  };
  std::vector<PartSpectrum> spectra;
  std::vector<Found> found;
  for (const ElasticPart& part : body.parts) {
    const PartSpectrum& spectrum = spectra.emplace_back(solve(part, options));
    for (Eigen::Index c = 0; c < spectrum.squared_frequency.size(); ++c)
      found.push_back({spectrum.squared_frequency[c], spectra.size() - 1, c});
  }
  std::stable_sort(found.begin(), found.end(), [](const Found& x, const Found& y) {
    return x.squared_frequency < y.squared_frequency;
  });
  if (found.size() > options.count) found.resize(options.count);

  Modes modes;
  modes.zero_modes_skipped = body.zero_mode_count();
  for (const Found& each : found) {
    const ElasticPart& part = body.parts[each.part];
    Mode& mode = modes.modes.emplace_back();
    mode.angular_frequency = std::sqrt(each.squared_frequency);
    mode.residual = spectra[each.part].residual[each.column];
    mode.shape.assign(body.node_count, Vec3::Zero());
    part.scatter(spectra[each.part].shapes.col(each.column).cwiseQuotient(part.root_mass),
                 mode.shape);
  }
  return modes;
}

Modes lowest_modes(const MassSpringModel& model, const ModeOptions& options) {
  return lowest_modes(elastic_body(model, {.progress = options.progress}), options);
}

}  // namespace springlod::elastic
