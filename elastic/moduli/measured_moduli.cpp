#include <algorithm>
#include <array>
#include <optional>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "base/error.hpp"
#include "elastic/moduli.hpp"

namespace springlod::elastic {
namespace {

/// The springs of a node are coplanar if their spread normal to the plane / spread within it (both
/// squared) is below this. It is 0.3 for a surface node of a lattice. Such a node is the tip of a
/// flat pyramid, whose height may change by many times the strain.
constexpr double kFlat = 0.03;
/// If the norm of the average strain / average norm of the local strains is below this, the average
/// is only a residue of cancellation. Stretches and shears have 0.2 to 1, bends and twists mostly
/// below 0.1. A ratio to the largest local strain would leave out stretches of bodies with thin
/// parts.
constexpr double kCancelled = 0.2;
/// Determinant of the normal equations / square of mu's entry. Below this, all strains are of one
/// kind (pure shear, isotropic) up to rounding, and determine only one of the two moduli.
constexpr double kSingular = 1e-6;

bool within_one_material(const MassSpringModel& model, std::uint32_t spring) {
  return model.material[model.a[spring]] == model.material[model.b[spring]];
}

/// For each node the inverse of the sum of u u^T over its springs within its material; zero if
/// these are coplanar.
std::vector<Mat3> inverse_spreads(const MassSpringModel& model) {
  std::vector<Mat3> spread(model.node_count(), Mat3::Zero());
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    if (!within_one_material(model, s)) continue;
    const Vec3 u = spring_direction(model, s);
    spread[model.a[s]] += u * u.transpose();
    spread[model.b[s]] += u * u.transpose();
  }
  for (Mat3& each : spread) {
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(each);
    const bool solid = axes.eigenvalues()[0] > kFlat * axes.eigenvalues()[2];
    each = solid ? Mat3(each.inverse()) : Mat3(Mat3::Zero());
  }
  return spread;
}

/// Strain of each node from the affine motion closest to that of its neighbours. One affine motion
/// for all nodes of a material would be wrong: its gradient is not the average of uneven strain
/// (forces per volume), and the relative motion of two regions of one material would count as
/// strain.
std::vector<Mat3> node_strains(const MassSpringModel& model, const std::vector<Mat3>& inverse,
                               const std::vector<Vec3>& displacement) {
  std::vector<Mat3> strain(model.node_count(), Mat3::Zero());
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    if (!within_one_material(model, s)) continue;
    const std::uint32_t a = model.a[s], b = model.b[s];
    const Vec3 r = model.rest[b] - model.rest[a];
    const Mat3 moved = (displacement[b] - displacement[a]) * r.transpose() / r.squaredNorm();
    strain[a] += moved;
    strain[b] += moved;
  }
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    const Mat3 gradient = strain[i] * inverse[i];
    strain[i] = (gradient + gradient.transpose()) / 2;
  }
  return strain;
}

/// Volume of a material's nodes [m3].
struct Volumes {
  double all = 0;
  double solid = 0;  ///< of nodes whose springs are not coplanar
};

std::vector<Volumes> material_volumes(const MassSpringModel& model,
                                      const std::vector<Mat3>& inverse) {
  std::vector<Volumes> volumes(model.materials.size());
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    Volumes& of = volumes[model.material[i]];
    of.all += model.volume[i];
    if (!inverse[i].isZero(0)) of.solid += model.volume[i];
  }
  return volumes;
}

/// Sums over a material.
struct Sums {
  Mat3 stress = Mat3::Zero();  ///< volume times stress
  Mat3 strain = Mat3::Zero();  ///< volume times strain
  double norms = 0;            ///< volume times the norm of the strain
};

std::vector<Sums> material_sums(const MassSpringModel& model, const std::vector<Mat3>& inverse,
                                const std::vector<Vec3>& displacement) {
  std::vector<Sums> sums(model.materials.size());
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const std::uint32_t a = model.a[s], b = model.b[s];
    const Vec3 u = spring_direction(model, s);
    const double tension = model.stiffness[s] * u.dot(displacement[b] - displacement[a]);
    const Mat3 half = tension * model.rest_length[s] / 2 * u * u.transpose();
    sums[model.material[a]].stress += half;
    sums[model.material[b]].stress += half;
  }
  const DilatationTerms& terms = model.dilatation;
  for (std::uint32_t t = 0; t < terms.count(); ++t) {
    const auto nodes = terms.nodes(t);
    const double each = terms.modulus[t] * linear_dilatation(terms, t, displacement) /
                        static_cast<double>(nodes.size());
    for (const std::uint32_t node : nodes)
      sums[model.material[node]].stress += each * Mat3::Identity();
  }
  const std::vector<Mat3> strain = node_strains(model, inverse, displacement);
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    Sums& of = sums[model.material[i]];
    of.strain += model.volume[i] * strain[i];
    of.norms += model.volume[i] * strain[i].norm();
  }
  return sums;
}

/// Normal equations for lambda and mu in stress = lambda tr(strain) 1 + 2 mu strain.
struct IsotropicFit {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();

  void add(const Mat3& stress, const Mat3& strain) {
    const std::array<Mat3, 2> law{strain.trace() * Mat3::Identity(), 2 * strain};
    for (Eigen::Index i = 0; i < 2; ++i) {
      const Mat3& row = law[static_cast<std::size_t>(i)];
      for (Eigen::Index j = 0; j < 2; ++j)
        normal(i, j) += row.cwiseProduct(law[static_cast<std::size_t>(j)]).sum();
      right[i] += row.cwiseProduct(stress).sum();
    }
  }

  /// Nothing if the strains do not determine both moduli, or the moduli are not those of a stable
  /// solid.
  std::optional<MaterialModuli> moduli() const {
    if (!(normal.determinant() > kSingular * normal(1, 1) * normal(1, 1))) return std::nullopt;
    const Eigen::Vector2d solved = normal.inverse() * right;
    const double lambda = solved[0], mu = solved[1];
    if (!(mu > 0 && 3 * lambda + 2 * mu > 0)) return std::nullopt;
    return MaterialModuli{.young = mu * (3 * lambda + 2 * mu) / (lambda + mu),
                          .poisson = lambda / (2 * (lambda + mu))};
  }
};

void add(const Sums& sums, const Volumes& volume, IsotropicFit& fit) {
  if (!(volume.solid > volume.all / 2)) return;
  const double size = sums.norms / volume.solid;
  const Mat3 strain = sums.strain / volume.solid / size;
  if (!(strain.norm() > kCancelled)) return;
  // By this scale soft and stiff loads have the same weight, and loads whose strains partly cancel
  // have less.
  fit.add(sums.stress / volume.all / size, strain);
}

}  // namespace

std::vector<MaterialModuli> measured_moduli(const MassSpringModel& model,
                                            const std::vector<StaticSolution>& solutions) {
  const std::vector<Mat3> inverse = inverse_spreads(model);
  const std::vector<Volumes> volumes = material_volumes(model, inverse);
  std::vector<IsotropicFit> fits(model.materials.size());
  for (const StaticSolution& solution : solutions) {
    if (solution.displacement.size() != model.rest.size())
      throw InputError(
          fmt::format("measured moduli: {} displacements for {} nodes; solve the "
                      "loads for this model",
                      solution.displacement.size(), model.rest.size()));
    const std::vector<Sums> sums = material_sums(model, inverse, solution.displacement);
    for (std::size_t m = 0; m < fits.size(); ++m) add(sums[m], volumes[m], fits[m]);
  }
  std::vector<MaterialModuli> all;
  for (std::uint32_t m = 0; m < fits.size(); ++m) {
    const std::optional<MaterialModuli> found = fits[m].moduli();
    if (!found) continue;
    all.push_back(*found);
    all.back().material = m;
    all.back().volume = volumes[m].all;
  }
  return all;
}

}  // namespace springlod::elastic
