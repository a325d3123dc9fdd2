#include "elastic/large_deflection.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"
#include "elastic/assembly.hpp"
#include "elastic/solver/sparse_cholesky.hpp"
#include "elastic/tangent.hpp"
#include "elastic/zero_modes.hpp"
#include "model/anchors.hpp"

namespace springlod::elastic {
namespace {

// A load step that Newton's method has not solved after this many iterations is halved, and one
// that took few makes the next twice as long [iterations].
constexpr std::uint32_t kMostIterations = 25;
constexpr std::uint32_t kFewIterations = 8;
// Shortest load step [1]: at a limit point no step is short enough.
constexpr double kLeastStep = 1. / 4096;

// A step along Newton's direction is taken if it decreases the energy by this fraction of what the
// slope promises (Armijo), or the forces that are left by a tenth: near the minimum, rounding hides
// changes of the energy.
constexpr double kSufficient = 1e-4;
constexpr double kFewerForces = 0.9;
constexpr int kHalvings = 20;

// Shift of a tangent that is not positive definite, over its largest diagonal element; it grows by
// the factor until the matrix is [1].
constexpr double kShift = 1e-8;
constexpr double kRaise = 100;

// Error of a coordinate over the farthest one [1]: the forces of springs have that error times
// their stiffness.
constexpr double kRounding = 4e-16;

/// Load steps and Newton's method.
class Equilibrium {
 public:
  Equilibrium(const MassSpringModel& model, const LargeLoad& load, const LargeOptions& options)
      : model_(model),
        load_(load),
        options_(options),
        x_(model.rest),
        places_(model.rest),
        pull_(model.node_count(), 0.0) {
    const std::vector<std::uint8_t> held = anchor_flags(model, load.anchored.nodes);
    for (const NodeSpring& spring : load.anchored.springs) pull_[spring.node] += spring.stiffness;
    for (std::uint32_t i = 0; i < model.node_count(); ++i)
      (held[i] != 0 ? held_ : free_).push_back(i);
    double farthest = 0;
    for (const Vec3& rest : model.rest) farthest = std::max(farthest, rest.cwiseAbs().maxCoeff());
    double square = 0;
    for (const double stiffness : model.stiffness) square += stiffness * stiffness;
    for (const double stiffness : pull_) square += stiffness * stiffness;
    rounding_ = kRounding * farthest * std::sqrt(square);
  }

  LargeSolution solve() {
    Task task(options_.progress, "deflect", kParts);
    double part = 0;
    double step = 1;
    std::uint64_t reported = 0;
    while (part < 1) {
      step = std::min(step, 1 - part);
      const std::vector<Vec3> before = x_;
      const std::vector<Vec3> places_before = places_;
      const std::uint32_t iterations = advance(part, part + step);
      result_.iterations += iterations;
      if (iterations == kFailed) {
        x_ = before;
        places_ = places_before;
        step /= 2;
        if (step < kLeastStep) throw_collapse(part);
        continue;
      }
      ++result_.load_steps;
      part = 1 - part - step < kLeastStep / 2 ? 1 : part + step;
      if (iterations <= kFewIterations) step *= 2;
      const auto done = static_cast<std::uint64_t>(part * kParts);
      task.advance(done - reported);
      reported = done;
    }
    return finish();
  }

 private:
  static constexpr std::uint64_t kParts = 1000;  // of progress
  static constexpr std::uint32_t kFailed = 0;

  [[noreturn]] void throw_collapse(double part) const {
    throw InputError(fmt::format(
        "deflect: no equilibrium was found beyond {:.3g} of the load: the body snaps through, or "
        "its "
        "springs give way; take a smaller load, or follow the motion with s.run and damping",
        part));
  }

  /// From the equilibrium at one part of the load to that at another. Returns the number of
  /// iterations, or kFailed.
  std::uint32_t advance(double from, double to) {
    if (!predict(from, to)) return kFailed;
    for (std::uint32_t iteration = 1; iteration <= kMostIterations; ++iteration) {
      find_forces(to);
      if (!std::isfinite(left_)) return kFailed;
      if (left_ <= options_.tolerance * acting_ + rounding_) return iteration;
      if (!descend(to)) return kFailed;
    }
    return kFailed;
  }

  /// Moves the held nodes, and the others as the tangent says.
  bool predict(double from, double to) {
    const std::vector<Vec3> before = places_;
    if (load_.hold) load_.hold(to, places_);
    if (free_.empty()) {
      x_ = places_;
      return true;
    }
    Eigen::VectorXd shift = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(x_.size()));
    for (const std::uint32_t i : held_) shift.segment<3>(row_of(i)) = places_[i] - x_[i];
    const Eigen::SparseMatrix<double> tangent = tangent_at(x_, Tangent::exact);
    const Eigen::VectorXd pull = tangent * shift;
    Eigen::VectorXd right(3 * static_cast<Eigen::Index>(free_.size()));
    for (std::size_t f = 0; f < free_.size(); ++f)
      right.segment<3>(row_of(f)) = (to - from) * load_.force[free_[f]] -
                                    pull.segment<3>(row_of(free_[f])) +
                                    pull_[free_[f]] * (places_[free_[f]] - before[free_[f]]);
    const std::optional<Eigen::VectorXd> change = solve(tangent, right);
    if (!change) return false;
    for (const std::uint32_t i : held_) x_[i] = places_[i];
    for (std::size_t f = 0; f < free_.size(); ++f) x_[free_[f]] += change->segment<3>(row_of(f));
    return true;
  }

  void find_forces(double part) {
    holding_ = holding_forces(model_, x_);
    double reaction = 0;
    gradient_.resize(3 * static_cast<Eigen::Index>(free_.size()));
    double load = 0;
    for (std::size_t f = 0; f < free_.size(); ++f) {
      const Vec3 force = part * load_.force[free_[f]];
      const Vec3 pulled = support_force(free_[f]);
      gradient_.segment<3>(row_of(f)) = holding_[free_[f]] - force - pulled;
      load += force.squaredNorm();
      reaction += pulled.squaredNorm();
    }
    for (const std::uint32_t i : held_) reaction += holding_[i].squaredNorm();
    left_ = gradient_.norm();
    acting_ = std::sqrt(std::max(load, reaction));
  }

  double energy(double part, const std::vector<Vec3>& x) const {
    double energy = stored_energy(x);
    for (const std::uint32_t i : free_) energy -= part * load_.force[i].dot(x[i] - model_.rest[i]);
    return energy;
  }

  double stored_energy(const std::vector<Vec3>& x) const {
    double energy = strain_energy(model_, x);
    for (const std::uint32_t i : free_)
      energy += 0.5 * pull_[i] * (x[i] - places_[i]).squaredNorm();
    return energy;
  }

  /// Of the springs of the support on a node [N].
  Vec3 support_force(std::uint32_t node) const { return pull_[node] * (places_[node] - x_[node]); }

  Eigen::SparseMatrix<double> tangent_at(const std::vector<Vec3>& x, Tangent kind) const {
    Eigen::SparseMatrix<double> tangent = tangent_matrix(model_, x, kind);
    for (const NodeSpring& spring : load_.anchored.springs)
      for (int d = 0; d < 3; ++d)
        tangent.coeffRef(row_of(spring.node) + d, row_of(spring.node) + d) += spring.stiffness;
    return tangent;
  }

  bool descend(double part) {
    std::optional<Eigen::VectorXd> direction = solve(tangent_at(x_, Tangent::exact), -gradient_);
    double slope = direction ? gradient_.dot(*direction) : 0;
    if (!(slope < 0)) {
      direction = solve_convex();
      slope = direction ? gradient_.dot(*direction) : 0;
    }
    if (!(slope < 0)) return false;
    const double before = energy(part, x_);
    const double left_before = left_;
    const std::vector<Vec3> start = x_;
    double length = 1;
    for (int halving = 0; halving < kHalvings; ++halving, length /= 2) {
      for (std::size_t f = 0; f < free_.size(); ++f)
        x_[free_[f]] = start[free_[f]] + length * direction->segment<3>(row_of(f));
      if (energy(part, x_) <= before + kSufficient * length * slope) return true;
      find_forces(part);
      if (left_ < kFewerForces * left_before) return true;
    }
    return false;
  }

  /// Without a value if the matrix of the free nodes is not positive definite.
  std::optional<Eigen::VectorXd> solve(const Eigen::SparseMatrix<double>& tangent,
                                       const Eigen::VectorXd& right) const {
    return solve_block(block_of_nodes(tangent, free_), right);
  }

  std::optional<Eigen::VectorXd> solve_block(const Eigen::SparseMatrix<double>& block,
                                             const Eigen::VectorXd& right) const {
    std::vector<Vec3> points;
    for (const std::uint32_t i : free_) points.push_back(model_.rest[i]);
    const SparseCholesky factor(block, points, options_.progress);
    if (!factor.positive()) return std::nullopt;
    Eigen::VectorXd solution = factor.solve(right);
    if (!solution.allFinite()) return std::nullopt;
    return solution;
  }

  std::optional<Eigen::VectorXd> solve_convex() const {
    Eigen::SparseMatrix<double> block = block_of_nodes(tangent_at(x_, Tangent::convex), free_);
    const double largest = block.diagonal().maxCoeff();
    double shifted = 0;
    for (double shift = kShift; shift < 1; shift *= kRaise) {
      for (Eigen::Index i = 0; i < block.rows(); ++i)
        block.coeffRef(i, i) += shift * largest - shifted;
      shifted = shift * largest;
      if (auto solution = solve_block(block, -gradient_)) return solution;
    }
    return std::nullopt;
  }

  LargeSolution finish() {
    result_.displacement.resize(x_.size());
    for (std::size_t i = 0; i < x_.size(); ++i) result_.displacement[i] = x_[i] - model_.rest[i];
    result_.reaction.assign(x_.size(), Vec3::Zero());
    for (const std::uint32_t i : held_) result_.reaction[i] = holding_[i] - load_.force[i];
    for (const std::uint32_t i : free_) result_.reaction[i] = support_force(i);
    result_.energy = stored_energy(x_);
    result_.residual = acting_ > 0 ? left_ / acting_ : 0;
    return result_;
  }

  template <class Number>
  static Eigen::Index row_of(Number node) {
    return 3 * static_cast<Eigen::Index>(node);
  }

  const MassSpringModel& model_;
  const LargeLoad& load_;
  const LargeOptions& options_;
  std::vector<std::uint32_t> held_, free_;  // ascending
  std::vector<Vec3> x_;
  std::vector<Vec3> places_;   // N: see LargeLoad::hold [m]
  std::vector<double> pull_;   // N: stiffness of the springs of the support [N/m]
  std::vector<Vec3> holding_;  // at the last find_forces() [N]
  Eigen::VectorXd gradient_;   // of the energy by the positions of the free nodes [N]
  double left_ = 0;            // its norm
  double acting_ = 0;          // norm of the load or of the reactions [N]
  double rounding_ = 0;        // [N]
  LargeSolution result_;
};

void check(const MassSpringModel& model, const LargeLoad& load) {
  if (load.force.size() != model.node_count())
    throw InputError(fmt::format("deflect: {} forces for {} nodes; give one per node",
                                 load.force.size(), model.node_count()));
  for (std::size_t i = 0; i < load.force.size(); ++i)
    if (!load.force[i].allFinite())
      throw InputError(
          fmt::format("deflect: the force on node {} is not finite", script_number(i)));
  validate(load.anchored, model);
  for (const ComponentModes& part : zero_modes(model, load.anchored.all_nodes()))
    if (part.zero_modes > 0)
      throw InputError(fmt::format(
          "deflect: the anchors leave {} motions of the component at node {} free, and at large "
          "displacements nothing balances them; anchor more nodes: three that do not lie in a line "
          "hold a solid component, and zero_modes lists the nodes of mechanisms",
          part.zero_modes, script_number(part.first_node)));
}

}  // namespace

LargeSolution deflect_far(const MassSpringModel& model, const LargeLoad& load,
                          const LargeOptions& options) {
  check(model, load);
  return Equilibrium(model, load, options).solve();
}

}  // namespace springlod::elastic
