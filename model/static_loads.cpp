#include "model/static_loads.hpp"

#include <array>

#include <fmt/format.h>

#include "model/error.hpp"

namespace springlod {
namespace {

/// Rounds of refinement, each of which takes out what the shift (sigma / lambda of the error) and
/// rounding did: two bring slender bars down to rounding as well.
constexpr int kRefinements = 2;

void check(const ElasticBody& body, const StaticLoad& load) {
  if (load.force.size() != body.node_count)
    throw InputError(fmt::format("static load {}: {} forces for {} nodes; give one a node",
                                 load.name, load.force.size(), body.node_count));
  for (std::size_t i = 0; i < load.force.size(); ++i)
    if (!load.force[i].allFinite())
      throw InputError(
          fmt::format("static load {}: the force on node {} is not finite", load.name, i));
}

void solve_part(const ElasticPart& part, const std::vector<StaticLoad>& loads,
                std::vector<StaticSolution>& solutions, Eigen::VectorXd& squared_force,
                Eigen::VectorXd& squared_rest) {
  const auto count = static_cast<Eigen::Index>(loads.size());
  Eigen::MatrixXd force(part.unknowns(), count);
  for (Eigen::Index c = 0; c < count; ++c)
    force.col(c) =
        part.gather(loads[static_cast<std::size_t>(c)].force).cwiseQuotient(part.root_mass);
  part.remove_zero_modes(force);
  Eigen::MatrixXd y = part.solve_shifted(force);
  for (int round = 0; round < kRefinements; ++round)
    y += part.solve_shifted(force - part.stiffness * y);
  Eigen::MatrixXd rest = force - part.stiffness * y;
  part.remove_zero_modes(rest);
  for (Eigen::Index c = 0; c < count; ++c) {
    StaticSolution& solution = solutions[static_cast<std::size_t>(c)];
    part.scatter(y.col(c).cwiseQuotient(part.root_mass), solution.displacement);
    solution.compliance += force.col(c).dot(y.col(c));
    squared_force[c] += force.col(c).squaredNorm();
    squared_rest[c] += rest.col(c).squaredNorm();
  }
}

/// Forces f_i = V_i field(r_i), scaled so that their amounts add up to 1 N.
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
    box.extend(model.rest[i]);
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
    // Pulls along one side and pushes along the other: a bending moment largest in the middle.
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
                                         const std::vector<StaticLoad>& loads) {
  std::vector<StaticSolution> solutions(loads.size());
  for (const StaticLoad& load : loads) check(body, load);
  for (StaticSolution& solution : solutions)
    solution.displacement.assign(body.node_count, Vec3::Zero());
  Eigen::VectorXd squared_force = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(loads.size()));
  Eigen::VectorXd squared_rest = squared_force;
  for (const ElasticPart& part : body.parts)
    solve_part(part, loads, solutions, squared_force, squared_rest);
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const auto c = static_cast<Eigen::Index>(i);
    if (squared_force[c] > 0) solutions[i].residual = std::sqrt(squared_rest[c] / squared_force[c]);
  }
  return solutions;
}

}  // namespace springlod
