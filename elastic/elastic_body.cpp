#include "elastic/elastic_body.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"
#include "elastic/solver/dense_kernels.hpp"
#include "elastic/solver/random_block.hpp"
#include "elastic/solver/sparse_cholesky.hpp"
#include "elastic/stable_step.hpp"
#include "elastic/stiffness.hpp"
#include "elastic/zero_modes.hpp"
#include "model/anchors.hpp"
#include "model/parts.hpp"

namespace springlod::elastic {
namespace {

/// Shift over the bound of the largest squared frequency: far above rounding in the factors (1e-15)
/// and below the softest modes.
constexpr double kShift = 1e-12;
/// What the shift is raised by if a pivot is lost to rounding, and how often.
constexpr double kRaise = 30;
constexpr int kRaises = 3;
/// Numbers in the zero modes of one part that are still stored [8 bytes each].
constexpr double kMostStored = 5e7;

/// Orthonormal rigid motions in mass-weighted unknowns: three translations and the `rotations`
/// turns about principal axes that move the part (2 for a straight line, 0 for a single node).
Eigen::MatrixXd rigid_motions(const MassSpringModel& part, const Eigen::VectorXd& root_mass,
                              Eigen::Index rotations) {
  const MassProperties whole = mass_properties(part);
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(whole.inertia);  // moments in rising order
  Eigen::MatrixXd motions(root_mass.size(), 3 + rotations);
  for (std::uint32_t i = 0; i < part.node_count(); ++i) {
    const auto row = 3 * static_cast<Eigen::Index>(i);
    motions.block<3, 3>(row, 0) = Mat3::Identity() * root_mass[row] / std::sqrt(whole.mass);
    for (Eigen::Index d = 0; d < rotations; ++d) {
      const Vec3 axis = principal.eigenvectors().col(2 - d);
      const double moment = principal.eigenvalues()[2 - d];
      motions.block<3, 1>(row, 3 + d) =
          axis.cross(part.rest[i] - whole.center) * root_mass[row] / std::sqrt(moment);
    }
  }
  return motions;
}

/// The 3n x 3n block of a 3N x 3N matrix that belongs to `n` rising nodes.
Eigen::SparseMatrix<double> block_of(const Eigen::SparseMatrix<double>& matrix,
                                     const std::vector<std::uint32_t>& nodes) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto size = 3 * static_cast<Eigen::Index>(nodes.size());
  Eigen::SparseMatrix<double> select(matrix.rows(), size);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int d = 0; d < 3; ++d)
      entries.emplace_back(static_cast<int>(3 * nodes[i]) + d, static_cast<int>(3 * i) + d, 1.0);
  select.setFromTriplets(entries.begin(), entries.end());
  return select.transpose() * matrix * select;
}

void factorise(ElasticPart& part, const MassSpringModel& model, const std::vector<Vec3>& points,
               Progress* progress) {
  const double bound = frequency_bound(model);
  part.shift = bound > 0 ? kShift * bound * bound : 1;
  for (int attempt = 0; attempt <= kRaises; ++attempt, part.shift *= kRaise) {
    Eigen::SparseMatrix<double> shifted = part.stiffness;
    for (Eigen::Index i = 0; i < part.unknowns(); ++i) shifted.coeffRef(i, i) += part.shift;
    part.factor = std::make_shared<const SparseCholesky>(shifted, points, progress);
    if (part.factor->positive()) return;
  }
  throw InputError(
      fmt::format("elastic analysis: the stiffness of the part at node {} cannot be factorised; "
                  "its springs or masses differ too much",
                  script_number(part.nodes.front())));
}

/// Inverse iteration: what the springs do not resist outgrows all else by lambda / sigma a pass.
void find_mechanisms(ElasticPart& part, Eigen::Index count) {
  constexpr int kPasses = 3;
  constexpr std::uint64_t kSeed = 1;  // any start finds the same space
  Eigen::MatrixXd motions = random_block(part.unknowns(), count, kSeed);
  for (int pass = 0; pass < kPasses; ++pass) {
    motions = part.solve_shifted(motions);
    motions = Eigen::HouseholderQR<Eigen::MatrixXd>(motions).householderQ() *
              Eigen::MatrixXd::Identity(part.unknowns(), count);
  }
  part.remove_zero_modes(motions);
  part.zero_modes.conservativeResize(Eigen::NoChange, part.zero_modes.cols() + count);
  part.zero_modes.rightCols(count) = motions;
}

/// `free`: the nodes of `whole` that can move.
ElasticPart make_part(const ModelPart& whole, const std::vector<std::uint32_t>& free,
                      const PartModes& found, Progress* progress) {
  const MassSpringModel& model = whole.model;
  ElasticPart part;
  std::vector<Vec3> points;
  part.root_mass.resize(3 * static_cast<Eigen::Index>(free.size()));
  for (std::size_t i = 0; i < free.size(); ++i) {
    part.nodes.push_back(whole.nodes[free[i]]);
    points.push_back(model.rest[free[i]]);
    part.root_mass.segment<3>(3 * static_cast<Eigen::Index>(i))
        .setConstant(std::sqrt(model.mass[free[i]]));
  }
  if (static_cast<double>(found.zero_modes) * static_cast<double>(part.unknowns()) > kMostStored)
    throw InputError(
        fmt::format("elastic analysis: the part at node {} has {} zero modes, too many to store; "
                    "zero_modes tells which nodes hang loose",
                    script_number(part.nodes.front()), found.zero_modes));
  part.stiffness = stiffness_matrix(model);
  if (free.size() < model.node_count()) part.stiffness = block_of(part.stiffness, free);
  for (Eigen::Index c = 0; c < part.unknowns(); ++c)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(part.stiffness, c); entry; ++entry)
      entry.valueRef() /= part.root_mass[entry.row()] * part.root_mass[c];
  part.zero_modes.resize(part.unknowns(), 0);
  if (found.anchored == 0)
    part.zero_modes =
        rigid_motions(model, part.root_mass, static_cast<Eigen::Index>(found.expected) - 3);
  factorise(part, model, points, progress);
  if (found.zero_modes > found.expected)
    find_mechanisms(part, static_cast<Eigen::Index>(found.zero_modes - found.expected));
  return part;
}

/// Numbers that are not finite would send the solvers round and round.
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
}

}  // namespace

void ElasticPart::remove_zero_modes(Eigen::MatrixXd& y) const {
  // Twice is enough to take them out to rounding.
  for (int pass = 0; pass < 2; ++pass)
    subtract_product(zero_modes, transposed_product(zero_modes, y), y);
}

Eigen::MatrixXd ElasticPart::solve_shifted(const Eigen::MatrixXd& b) const {
  Eigen::MatrixXd y = b;
  remove_zero_modes(y);
  y = factor->solve(y);
  remove_zero_modes(y);
  return y;
}

Eigen::VectorXd ElasticPart::gather(const std::vector<Vec3>& of_model) const {
  Eigen::VectorXd y(unknowns());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    y.segment<3>(3 * static_cast<Eigen::Index>(i)) = of_model[nodes[i]];
  return y;
}

void ElasticPart::scatter(const Eigen::VectorXd& of_part, std::vector<Vec3>& of_model) const {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    of_model[nodes[i]] = of_part.segment<3>(3 * static_cast<Eigen::Index>(i));
}

std::uint32_t ElasticBody::zero_mode_count() const {
  std::uint32_t count = 0;
  for (const ElasticPart& part : parts) count += static_cast<std::uint32_t>(part.zero_modes.cols());
  return count;
}

ElasticBody elastic_body(const MassSpringModel& model, const ElasticOptions& options) {
  require_finite(model);
  const std::vector<std::uint8_t> held = anchor_flags(model, options.anchored);
  const std::vector<PartModes> found = zero_modes(model, options.anchored);
  const std::vector<ModelPart> parts = split_parts(model, connected_components(model));
  ElasticBody body;
  body.node_count = model.node_count();
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    if (held[i] != 0) body.anchored.push_back(i);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    std::vector<std::uint32_t> free;
    for (std::uint32_t i = 0; i < parts[p].nodes.size(); ++i)
      if (held[parts[p].nodes[i]] == 0) free.push_back(i);
    if (!free.empty()) body.parts.push_back(make_part(parts[p], free, found[p], options.progress));
  }
  return body;
}

}  // namespace springlod::elastic
