#include "elastic/modes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <fmt/format.h>

#include "base/available_memory.hpp"
#include "base/error.hpp"
#include "base/script_number.hpp"
#include "elastic/solver/dense_kernels.hpp"
#include "elastic/solver/random_block.hpp"

namespace springlod::elastic {
namespace {

/// Block size: multiple frequencies are found reliably up to this multiplicity. Solving for 8
/// vectors at once costs little more than twice one.
constexpr Eigen::Index kBlock = 8;
/// Up to this many unknowns a dense eigenvalue solver is faster than the iteration.
constexpr Eigen::Index kDenseUnknowns = 240;
/// If the iteration does not converge, the dense solver takes over up to this many unknowns (a
/// minute).
constexpr Eigen::Index kMostDenseUnknowns = 4000;
/// Size of the random part of start vectors made of given shapes, relative to that of the shapes:
/// it finds the modes that these lack.
constexpr double kRandomPart = 0.1;
/// Smallest eigenvalue / shift that is significant despite rounding in the matrix.
constexpr double kLeastOfShift = 1e-3;

/// Modes of one component in its mass-weighted unknowns.
struct ComponentSpectrum {
  Eigen::VectorXd squared_frequency;  // ascending
  Eigen::VectorXd residual;
  Eigen::MatrixXd shapes;  // orthonormal columns
};

/// The spectrum without the zero modes, up to `count` modes.
ComponentSpectrum solve_dense(const ElasticComponent& component, Eigen::Index count) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver{Eigen::MatrixXd(component.stiffness)};
  const Eigen::Index zeros = component.zero_modes.cols();
  const Eigen::Index found = std::min(count, component.unknowns() - zeros);
  ComponentSpectrum spectrum;
  spectrum.squared_frequency = solver.eigenvalues().segment(zeros, found).cwiseMax(0);
  spectrum.shapes = solver.eigenvectors().middleCols(zeros, found);
  const Eigen::MatrixXd rest = component.stiffness * spectrum.shapes -
                               spectrum.shapes * spectrum.squared_frequency.asDiagonal();
  spectrum.residual = rest.colwise().norm().transpose().cwiseQuotient(spectrum.squared_frequency);
  return spectrum;
}

/// Block Lanczos for the largest eigenvalues theta = 1 / (lambda + sigma), with full
/// reorthogonalization.
class BlockLanczos {
 public:
  BlockLanczos(const ElasticComponent& component, Eigen::Index count, const ModeOptions& options)
      : component_(component),
        count_(count),
        accuracy_(options.accuracy),
        // Most bodies need two to five vectors for each mode.
        most_vectors_(
            std::min(8 * count + 300, component.unknowns() - component.zero_modes.cols() - kBlock)),
        task_(options.progress, "iterating for modes", static_cast<std::uint64_t>(count)),
        next_look_(count) {
    next_ = start_vectors(component, options);
    component_.remove_zero_modes(next_);
    orthonormalise(next_);
  }

  /// Returns nothing if the iteration has not converged within most_vectors_.
  std::optional<ComponentSpectrum> run() {
    while (vectors_ + kBlock <= most_vectors_) {
      expand();
      task_.advance(0);  // lets the user interrupt
      if (vectors_ >= next_look_ && converged()) return spectrum();
    }
    return std::nullopt;
  }

 private:
  static Eigen::MatrixXd start_vectors(const ElasticComponent& component,
                                       const ModeOptions& options) {
    Eigen::MatrixXd start = random_block(component.unknowns(), kBlock, options.seed);
    if (options.start.empty()) return start;
    const auto count = static_cast<Eigen::Index>(options.start.size());
    Eigen::MatrixXd shapes(component.unknowns(), count);
    for (Eigen::Index i = 0; i < count; ++i)
      shapes.col(i) = component.gather(options.start[static_cast<std::size_t>(i)])
                          .cwiseProduct(component.root_mass);
    // Mass-normalised shapes have norm 1, the random vectors that of the square root of the size.
    start *= kRandomPart *
             std::sqrt(static_cast<double>(count) / static_cast<double>(component.unknowns()));
    return start + shapes * random_block(count, kBlock, options.seed);
  }

  /// QR decomposition: `block` becomes Q, and R is returned.
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
      basis_.conservativeResize(component_.unknowns(), room);
    }
    basis_.middleCols(vectors_, kBlock) = next_;
    vectors_ += kBlock;
    const auto basis = basis_.leftCols(vectors_);

    next_ = component_.solve_shifted(next_);
    Eigen::MatrixXd along = transposed_product(basis, next_);
    subtract_product(basis, along, next_);
    const Eigen::MatrixXd again = transposed_product(basis, next_);  // left by rounding
    subtract_product(basis, again, next_);
    along += again;
    projected_.conservativeResize(vectors_, vectors_);
    projected_.bottomRows(kBlock) = along.transpose();  // the solver reads the lower triangle only
    coupling_ = orthonormalise(next_);
    // If the Krylov space is exhausted (bodies with many equal frequencies), the new vectors are
    // rounding errors. After orthogonalization, they serve as new start vectors.
    subtract_product(basis, transposed_product(basis, next_), next_);
    component_.remove_zero_modes(next_);
    coupling_ = orthonormalise(next_) * coupling_;
  }

  bool converged() {
    // The cost of the test grows with the cube of the number of vectors. It is therefore repeated
    // only after that number has grown by a tenth.
    next_look_ = vectors_ + vectors_ / 10;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(projected_);
    theta_ = solver.eigenvalues().tail(count_).reverse();
    ritz_ = solver.eigenvectors().rightCols(count_).rowwise().reverse();
    const Eigen::VectorXd rest =
        (coupling_ * ritz_.bottomRows(kBlock)).colwise().norm().transpose();
    // The residual of theta is amplified in a lambda that is smaller than sigma.
    const Eigen::VectorXd amplified =
        (1 - component_.shift * theta_.array()).max(kLeastOfShift).inverse();
    residual_ = rest.cwiseQuotient(theta_).cwiseProduct(amplified);
    const auto done = (residual_.array() <= accuracy_).count();
    if (done > reported_) task_.advance(static_cast<std::uint64_t>(done - reported_));
    reported_ = std::max(reported_, done);
    return done == count_;
  }

  ComponentSpectrum spectrum() const {
    ComponentSpectrum spectrum;
    spectrum.squared_frequency = (theta_.cwiseInverse().array() - component_.shift).max(0.0);
    spectrum.residual = residual_;
    // One more product damps the remaining high frequencies, which would distort strains.
    spectrum.shapes = component_.solve_shifted(basis_.leftCols(vectors_) * ritz_);
    spectrum.shapes.colwise().normalize();
    return spectrum;
  }

  const ElasticComponent& component_;
  Eigen::Index count_;
  double accuracy_;
  Eigen::Index most_vectors_;
  Task task_;
  Eigen::Index next_look_;
  Eigen::Index vectors_ = 0;
  Eigen::Index reported_ = 0;
  Eigen::MatrixXd basis_;      // orthonormal, the first vectors_ columns
  Eigen::MatrixXd next_;       // the next block of it
  Eigen::MatrixXd projected_;  // basis^T (D + sigma)^-1 basis, lower triangle
  Eigen::MatrixXd coupling_;   // of the last block to the next
  Eigen::VectorXd theta_, residual_;
  Eigen::MatrixXd ritz_;
};

/// With values that are not finite the iteration would neither converge nor fail before its limit.
void require_finite(const ElasticComponent& component) {
  const Eigen::Map<const Eigen::VectorXd> entries(component.stiffness.valuePtr(),
                                                  component.stiffness.nonZeros());
  if (!entries.allFinite())
    throw InputError(fmt::format(
        "modes: the stiffness over the masses of the component at node {} "
        "is not finite; check for springs that are far too stiff or masses far too small",
        script_number(component.nodes.front())));
}

/// Number of modes to look for in a component.
Eigen::Index count_of(const ElasticComponent& component, const ModeOptions& options) {
  const Eigen::Index there = component.unknowns() - component.zero_modes.cols();
  return std::min(static_cast<Eigen::Index>(options.count), there);
}

/// For the largest component: the others need less.
void require_memory_for(const ElasticBody& body, const ModeOptions& options) {
  // Of each mode at least: two vectors of the basis, the shape in the unknowns and at the nodes.
  constexpr double kVectors = 4;
  const auto largest =
      std::max_element(body.components.begin(), body.components.end(),
                       [](const auto& l, const auto& r) { return l.unknowns() < r.unknowns(); });
  if (largest == body.components.end()) return;
  const Eigen::Index count = count_of(*largest, options);
  const double of_each = kVectors * sizeof(double) * static_cast<double>(largest->unknowns());
  require_memory(of_each * static_cast<double>(count),
                 fmt::format("modes: {} modes of {} nodes need", count, largest->nodes.size()),
                 [&](double available) {
                   return fmt::format("request at most {:.0f}", std::floor(available / of_each));
                 });
}

ComponentSpectrum solve(const ElasticComponent& component, const ModeOptions& options) {
  require_finite(component);
  const Eigen::Index count = count_of(component, options);
  if (component.unknowns() > kDenseUnknowns)
    if (auto spectrum = BlockLanczos(component, count, options).run()) return *std::move(spectrum);
  if (component.unknowns() > kMostDenseUnknowns)
    throw InputError(fmt::format(
        "modes: the iteration for {} modes of {} nodes did not converge; request fewer, or "
        "an accuracy coarser than {}",
        count, component.nodes.size(), options.accuracy));
  return solve_dense(component, count);
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
  require_memory_for(body, options);
  struct Found {
    double squared_frequency;
    std::size_t component;
    Eigen::Index column;
  };
  std::vector<ComponentSpectrum> spectra;
  std::vector<Found> found;
  for (const ElasticComponent& component : body.components) {
    const ComponentSpectrum& spectrum = spectra.emplace_back(solve(component, options));
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
    const ElasticComponent& component = body.components[each.component];
    Mode& mode = modes.modes.emplace_back();
    mode.angular_frequency = std::sqrt(each.squared_frequency);
    mode.residual = spectra[each.component].residual[each.column];
    mode.shape.assign(body.node_count, Vec3::Zero());
    component.scatter(
        spectra[each.component].shapes.col(each.column).cwiseQuotient(component.root_mass),
        mode.shape);
  }
  return modes;
}

Modes lowest_modes(const MassSpringModel& model, const ModeOptions& options) {
  return lowest_modes(elastic_body(model, {.progress = options.progress}), options);
}

}  // namespace springlod::elastic
