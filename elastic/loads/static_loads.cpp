#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"
#include "elastic/loads.hpp"
#include "elastic/solver/conjugate_gradients.hpp"

namespace springlod::elastic {
namespace {

/// Most steps of conjugate gradients. The preconditioned matrix has the eigenvalues lambda /
/// (lambda + sigma), so the second step usually only corrects rounding. A bar a thousand times as
/// long as thick, whose lowest bending eigenvalues are of the size of the shift, needs a few more.
constexpr int kMostSteps = 30;
/// Step / solution at which a load counts as solved.
constexpr double kSolved = 1e-12;

void check(const ElasticBody& body, const StaticLoad& load) {
  if (load.force.size() != body.node_count)
    throw InputError(fmt::format("static load {}: {} forces for {} nodes; give one per node",
                                 load.name, load.force.size(), body.node_count));
  for (std::size_t i = 0; i < load.force.size(); ++i)
    if (!load.force[i].allFinite())
      throw InputError(fmt::format("static load {}: the force on node {} is not finite", load.name,
                                   script_number(i)));
}

/// Largest component of a load along the zero modes that counts as 0, relative to the norm of the
/// load: far above rounding in either.
constexpr double kPushes = 1e-9;

/// Rejects a load that acts on a motion which the anchors leave free: it has no static solution.
void check_held(const ElasticComponent& component, const StaticLoad& load,
                const Eigen::VectorXd& force) {
  const Eigen::VectorXd free = component.zero_modes.transpose() * force;
  if (free.norm() <= kPushes * force.norm()) return;
  const Eigen::VectorXd motion = (component.zero_modes * free).cwiseQuotient(component.root_mass);
  Eigen::Index farthest = 0;
  motion.reshaped(3, motion.size() / 3).colwise().norm().maxCoeff(&farthest);
  throw InputError(
      fmt::format("static load {}: it acts on a motion that neither springs nor anchors resist; "
                  "node {} moves most; anchor more nodes: three that do not lie in a line hold a "
                  "solid component, and zero_modes lists the nodes of mechanisms",
                  load.name, script_number(component.nodes[static_cast<std::size_t>(farthest)])));
}

/// Solves D y = force by conjugate gradients, preconditioned with the shifted factor. `direction`:
/// the preconditioned force.
ConjugateGradientSolution iterate(const ElasticComponent& component, const Eigen::MatrixXd& force,
                                  Eigen::MatrixXd direction, double relative_tolerance) {
  return conjugate_gradients(
      force, std::move(direction), kMostSteps,
      [&](const Eigen::MatrixXd& y) -> Eigen::MatrixXd { return component.stiffness * y; },
      [&](const Eigen::MatrixXd& residual) { return component.solve_shifted(residual); },
      [&](Eigen::Index c, const ConjugateGradientSolution& solved,
          const Eigen::MatrixXd& residual) {
        return solved.last_step[c] <= kSolved * kSolved * solved.x.col(c).squaredNorm() ||
               residual.col(c).norm() <= relative_tolerance * force.col(c).norm();
      });
}

ConjugateGradientSolution solve_balanced(const ElasticComponent& component,
                                         const Eigen::MatrixXd& force, double relative_tolerance) {
  Eigen::MatrixXd y = component.solve_shifted(force);
  // The residual, force - D y = shift y, is known without a matrix product. For most bodies, which
  // are much stiffer than the shift, it is within the tolerance already.
  const Eigen::VectorXd left = component.shift * y.colwise().norm();
  const Eigen::VectorXd allowed = relative_tolerance * force.colwise().norm();
  if ((left.array() > allowed.array()).any())
    return iterate(component, force, std::move(y), relative_tolerance);
  return {std::move(y), Eigen::VectorXd::Zero(force.cols())};
}

/// Sums of squares over the components, for each load.
struct Sizes {
  Eigen::VectorXd solution, last_step;
};

void solve_component(const ElasticComponent& component, bool anchored,
                     const std::vector<StaticLoad>& loads, double relative_tolerance,
                     std::vector<StaticSolution>& solutions, Sizes& sizes) {
  const auto count = static_cast<Eigen::Index>(loads.size());
  Eigen::MatrixXd force(component.unknowns(), count);
  for (Eigen::Index c = 0; c < count; ++c) {
    const StaticLoad& load = loads[static_cast<std::size_t>(c)];
    force.col(c) = component.gather(load.force).cwiseQuotient(component.root_mass);
    if (anchored) check_held(component, load, force.col(c));
  }
  component.remove_zero_modes(force);
  const auto [y, last_step] = solve_balanced(component, force, relative_tolerance);
  sizes.solution += y.colwise().squaredNorm().transpose();
  sizes.last_step += last_step;
  for (Eigen::Index c = 0; c < count; ++c) {
    StaticSolution& solution = solutions[static_cast<std::size_t>(c)];
    component.scatter(y.col(c).cwiseQuotient(component.root_mass), solution.displacement);
    solution.compliance += force.col(c).dot(y.col(c));
  }
}

/// Forces f_i = V_i field(r_i), scaled so that their magnitudes add up to 1 N.
template <class Field>
StaticLoad load_of(const MassSpringModel& model, const Vec3& center, std::string name,
                   const Field& field) {
  StaticLoad load{std::move(name), {}};
  double sum = 0;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    load.force.emplace_back(model.volume[i] * field((model.rest[i] - center).eval()));
    sum += load.force.back().norm();
  }
  if (sum > 0)
    for (Vec3& force : load.force) force /= sum;
  return load;
}

}  // namespace

std::vector<StaticLoad> smooth_loads(const MassSpringModel& model) {
  Vec3 center = Vec3::Zero();
  double volume = 0;
  Box3 box;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    center += model.volume[i] * model.rest[i];
    volume += model.volume[i];
    if (model.volume[i] > 0) box.extend(model.rest[i]);
  }
  center /= volume;
  Eigen::Index longest = 0;
  box.sizes().maxCoeff(&longest);

  constexpr std::array kName{'x', 'y', 'z'};
  const auto name = [&](Eigen::Index d) { return kName[static_cast<std::size_t>(d)]; };
  std::vector<StaticLoad> loads;
  for (Eigen::Index d = 0; d < 3; ++d)
    loads.push_back(load_of(model, center, fmt::format("stretch {}", name(d)),
                            [d](const Vec3& r) -> Vec3 { return r[d] * Vec3::Unit(d); }));
  for (Eigen::Index d = 0; d < 3; ++d) {
    const Eigen::Index e = d == 0 ? 1 : 0, f = d == 2 ? 1 : 2;
    loads.push_back(load_of(
        model, center, fmt::format("shear {}{}", name(e), name(f)),
        [e, f](const Vec3& r) -> Vec3 { return r[e] * Vec3::Unit(f) + r[f] * Vec3::Unit(e); }));
  }
  for (Eigen::Index across = 0; across < 3; ++across) {
    if (across == longest) continue;
    // Pulls on one side and pushes on the other: a bending moment that is largest in the middle.
    loads.push_back(load_of(model, center,
                            fmt::format("bend {} to {}", name(longest), name(across)),
                            [longest, across](const Vec3& r) -> Vec3 {
                              return r[longest] * r[across] * Vec3::Unit(longest);
                            }));
  }
  loads.push_back(load_of(
      model, center, fmt::format("twist {}", name(longest)),
      [longest](const Vec3& r) -> Vec3 { return r[longest] * Vec3::Unit(longest).cross(r); }));
  return loads;
}

std::vector<StaticSolution> solve_static(const ElasticBody& body,
                                         const std::vector<StaticLoad>& loads,
                                         const StaticOptions& options) {
  for (const StaticLoad& load : loads) check(body, load);
  std::vector<StaticSolution> solutions(loads.size());
  if (loads.empty()) return solutions;
  for (StaticSolution& solution : solutions)
    solution.displacement.assign(body.node_count, Vec3::Zero());
  const auto count = static_cast<Eigen::Index>(loads.size());
  Sizes sizes{Eigen::VectorXd::Zero(count), Eigen::VectorXd::Zero(count)};
  for (const ElasticComponent& component : body.components)
    solve_component(component, !body.anchored.empty() && !options.balance_free_motions, loads,
                    options.relative_tolerance, solutions, sizes);
  for (Eigen::Index c = 0; c < count; ++c)
    if (sizes.solution[c] > 0)
      solutions[static_cast<std::size_t>(c)].residual =
          std::sqrt(sizes.last_step[c] / sizes.solution[c]);
  return solutions;
}

}  // namespace springlod::elastic
