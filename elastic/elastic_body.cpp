#include "elastic/elastic_body.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"
#include "elastic/assembly.hpp"
#include "elastic/solver/dense_kernels.hpp"
#include "elastic/solver/random_block.hpp"
#include "elastic/solver/sparse_cholesky.hpp"
#include "elastic/stable_step.hpp"
#include "elastic/stiffness.hpp"
#include "elastic/zero_modes.hpp"
#include "model/anchors.hpp"
#include "model/components.hpp"

namespace springlod::elastic {
namespace {

/// Shift / bound of the largest squared frequency: far above rounding in the factors (1e-15), and
/// below the softest modes.
constexpr double kShift = 1e-12;
/// Factor by which the shift grows if rounding makes a pivot negative, and how often it may.
constexpr double kRaise = 30;
constexpr int kRaises = 3;
/// Most values in the stored zero modes of a component [8 bytes each].
constexpr double kMostStored = 5e7;

/// Orthonormal rigid motions in mass-weighted unknowns: three translations, and the `rotations`
/// about principal axes that move the component (2 for a straight line, 0 for a single node).
Eigen::MatrixXd rigid_motions(const MassSpringModel& component, const Eigen::VectorXd& root_mass,
                              Eigen::Index rotations) {
  const MassProperties whole = mass_properties(component);
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(whole.inertia);  // moments in ascending order
  Eigen::MatrixXd motions(root_mass.size(), 3 + rotations);
  for (std::uint32_t i = 0; i < component.node_count(); ++i) {
    const auto row = 3 * static_cast<Eigen::Index>(i);
    motions.block<3, 3>(row, 0) = Mat3::Identity() * root_mass[row] / std::sqrt(whole.mass);
    for (Eigen::Index d = 0; d < rotations; ++d) {
      const Vec3 axis = principal.eigenvectors().col(2 - d);
      const double moment = principal.eigenvalues()[2 - d];
      motions.block<3, 1>(row, 3 + d) =
          axis.cross(component.rest[i] - whole.center) * root_mass[row] / std::sqrt(moment);
    }
  }
  return motions;
}

void factorise(ElasticComponent& component, const MassSpringModel& model,
               const std::vector<Vec3>& points, Progress* progress) {
  const double bound = frequency_bound(model);
  component.shift = bound > 0 ? kShift * bound * bound : 1;
  for (int attempt = 0; attempt <= kRaises; ++attempt, component.shift *= kRaise) {
    Eigen::SparseMatrix<double> shifted = component.stiffness;
    for (Eigen::Index i = 0; i < component.unknowns(); ++i)
      shifted.coeffRef(i, i) += component.shift;
    component.factor = std::make_shared<const SparseCholesky>(shifted, points, progress);
    if (component.factor->positive()) return;
  }
  throw InputError(fmt::format(
      "elastic analysis: the stiffness of the component at node {} cannot be factorised; "
      "its springs or masses differ too much{}",
      script_number(component.nodes.front()),
      model.dilatation.empty()
          ? ""
          : ", or the dilatation terms of a Poisson's ratio below 1/4 soften a motion of its nodes "
            "more than its springs stiffen it"));
}

/// Inverse iteration: in each pass, motions that no spring resists grow relative to the others by
/// lambda / sigma.
void find_mechanisms(ElasticComponent& component, Eigen::Index count) {
  constexpr int kPasses = 3;
  constexpr std::uint64_t kSeed = 1;  // any start vectors lead to the same space
  Eigen::MatrixXd motions = random_block(component.unknowns(), count, kSeed);
  for (int pass = 0; pass < kPasses; ++pass) {
    motions = component.solve_shifted(motions);
    motions = Eigen::HouseholderQR<Eigen::MatrixXd>(motions).householderQ() *
              Eigen::MatrixXd::Identity(component.unknowns(), count);
  }
  component.remove_zero_modes(motions);
  component.zero_modes.conservativeResize(Eigen::NoChange, component.zero_modes.cols() + count);
  component.zero_modes.rightCols(count) = motions;
}

/// The nodes of a component that are not anchored, ascending.
struct FreeNodes {
  std::vector<std::uint32_t> nodes;  ///< numbers within the component
  std::vector<double> stiffness;     ///< of the springs of the support at each of them [N/m]
};

ElasticComponent make_component(const ModelComponent& whole, const FreeNodes& free_nodes,
                                const ComponentModes& found, Progress* progress) {
  const std::vector<std::uint32_t>& free = free_nodes.nodes;
  const MassSpringModel& model = whole.model;
  ElasticComponent component;
  std::vector<Vec3> points;
  component.root_mass.resize(3 * static_cast<Eigen::Index>(free.size()));
  for (std::size_t i = 0; i < free.size(); ++i) {
    component.nodes.push_back(whole.nodes[free[i]]);
    points.push_back(model.rest[free[i]]);
    component.root_mass.segment<3>(3 * static_cast<Eigen::Index>(i))
        .setConstant(std::sqrt(model.mass[free[i]]));
  }
  if (static_cast<double>(found.zero_modes) * static_cast<double>(component.unknowns()) >
      kMostStored)
    throw InputError(
        fmt::format("elastic analysis: the component at node {} has {} zero modes, too many to "
                    "store; zero_modes lists the nodes of mechanisms",
                    script_number(component.nodes.front()), found.zero_modes));
  component.stiffness = stiffness_matrix(model);
  if (free.size() < model.node_count())
    component.stiffness = block_of_nodes(component.stiffness, free);
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (free_nodes.stiffness[i] == 0) continue;  // most nodes, and a search in the matrix for each
    for (Eigen::Index c = 3 * static_cast<Eigen::Index>(i), end = c + 3; c < end; ++c)
      component.stiffness.coeffRef(c, c) += free_nodes.stiffness[i];
  }
  for (Eigen::Index c = 0; c < component.unknowns(); ++c)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(component.stiffness, c); entry; ++entry)
      entry.valueRef() /= component.root_mass[entry.row()] * component.root_mass[c];
  component.zero_modes.resize(component.unknowns(), 0);
  if (found.anchored == 0)
    component.zero_modes =
        rigid_motions(model, component.root_mass, static_cast<Eigen::Index>(found.expected) - 3);
  factorise(component, model, points, progress);
  if (found.zero_modes > found.expected)
    find_mechanisms(component, static_cast<Eigen::Index>(found.zero_modes - found.expected));
  return component;
}

/// Values that are not finite would keep the solvers iterating to their limits.
void require_finite(const MassSpringModel& model) {
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    if (!model.rest[i].allFinite() || !(model.mass[i] > 0 && std::isfinite(model.mass[i])))
      throw InputError(
          fmt::format("elastic analysis: node {} has a mass of {} kg and is at {} "
                      "{} {} m; all of them must be finite, and the mass above 0",
                      script_number(i), model.mass[i], model.rest[i].x(), model.rest[i].y(),
                      model.rest[i].z()));
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    if (!std::isfinite(model.stiffness[s]))
      throw InputError(
          fmt::format("elastic analysis: the spring of the nodes {} and {} has a "
                      "stiffness of {} N/m, which must be finite",
                      script_number(model.a[s]), script_number(model.b[s]), model.stiffness[s]));
  for (std::uint32_t t = 0; t < model.dilatation.count(); ++t)
    if (!std::isfinite(model.dilatation.modulus[t]))
      throw InputError(
          fmt::format("elastic analysis: dilatation term {} has a modulus of {} J, which must be "
                      "finite",
                      script_number(t), model.dilatation.modulus[t]));
}

}  // namespace

void ElasticComponent::remove_zero_modes(Eigen::MatrixXd& y) const {
  // Two passes remove them up to rounding.
  for (int pass = 0; pass < 2; ++pass)
    subtract_product(zero_modes, transposed_product(zero_modes, y), y);
}

Eigen::MatrixXd ElasticComponent::solve_shifted(const Eigen::MatrixXd& b) const {
  Eigen::MatrixXd y = b;
  remove_zero_modes(y);
  y = factor->solve(y);
  remove_zero_modes(y);
  return y;
}

Eigen::VectorXd ElasticComponent::gather(const std::vector<Vec3>& of_model) const {
  Eigen::VectorXd y(unknowns());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    y.segment<3>(3 * static_cast<Eigen::Index>(i)) = of_model[nodes[i]];
  return y;
}

void ElasticComponent::scatter(const Eigen::VectorXd& of_component,
                               std::vector<Vec3>& of_model) const {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    of_model[nodes[i]] = of_component.segment<3>(3 * static_cast<Eigen::Index>(i));
}

std::uint32_t ElasticBody::zero_mode_count() const {
  std::uint32_t count = 0;
  for (const ElasticComponent& component : components)
    count += static_cast<std::uint32_t>(component.zero_modes.cols());
  return count;
}

ElasticBody elastic_body(const MassSpringModel& model, const ElasticOptions& options) {
  require_finite(model);
  validate(options.anchored, model);
  const std::vector<std::uint8_t> held = anchor_flags(model, options.anchored.nodes);
  std::vector<double> pull(model.node_count(), 0.0);  // of springs of the support [N/m]
  for (const NodeSpring& spring : options.anchored.springs) pull[spring.node] += spring.stiffness;
  const std::vector<ComponentModes> found = zero_modes(model, options.anchored.all_nodes());
  const std::vector<ModelComponent> components =
      split_components(model, connected_components(model));
  ElasticBody body;
  body.node_count = model.node_count();
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    if (held[i] != 0) body.anchored.nodes.push_back(i);
  body.anchored.springs = options.anchored.springs;
  for (std::size_t p = 0; p < components.size(); ++p) {
    FreeNodes free;
    for (std::uint32_t i = 0; i < components[p].nodes.size(); ++i) {
      const std::uint32_t node = components[p].nodes[i];
      if (held[node] != 0) continue;
      free.nodes.push_back(i);
      free.stiffness.push_back(pull[node]);
    }
    if (!free.nodes.empty())
      body.components.push_back(make_component(components[p], free, found[p], options.progress));
  }
  return body;
}

}  // namespace springlod::elastic
