#include "lod/mass_moments.hpp"

#include <algorithm>

#include <Eigen/QR>

namespace springlod {
namespace {

/// A mass never falls below this part of itself in one correction.
constexpr double kLeastFactor = 0.2;
/// The correction is linear in the masses: a second one takes out what rounding and kLeastFactor
/// left.
constexpr int kCorrections = 3;

}  // namespace

MassMoments::MassMoments(const MassSpringModel& model) {
  const Box3 box = bounds(model.rest);
  const double scale = box.diagonal().norm() > 0 ? 2 / box.diagonal().norm() : 1;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    const Vec3 x = scale * (model.rest[i] - box.center());
    Moments& m = monomials_.emplace_back();
    m << 1, x, x.cwiseAbs2(), x.x() * x.y(), x.x() * x.z(), x.y() * x.z();
    wanted_ += model.mass[i] * m;
  }
}

void MassMoments::project(const std::vector<double>& mass,
                          Eigen::Ref<Eigen::MatrixXd> changes) const {
  Eigen::Matrix<double, Eigen::Dynamic, 10> slopes(changes.rows(), 10);
  for (Eigen::Index i = 0; i < changes.rows(); ++i) {
    const auto node = static_cast<std::size_t>(i);
    slopes.row(i) = mass[node] * monomials_[node].transpose();
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(slopes);
  Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(changes.rows(), qr.rank());
  basis = qr.householderQ() * basis;
  changes -= basis * (basis.transpose() * changes).eval();
}

void MassMoments::restore(std::vector<double>& mass) const {
  for (int pass = 0; pass < kCorrections; ++pass) {
    Eigen::Matrix<double, 10, 10> response = Eigen::Matrix<double, 10, 10>::Zero();
    Moments missing = wanted_;
    for (std::size_t i = 0; i < mass.size(); ++i) {
      response += mass[i] * monomials_[i] * monomials_[i].transpose();
      missing -= mass[i] * monomials_[i];
    }
    const Moments factor = response.completeOrthogonalDecomposition().solve(missing);
    for (std::size_t i = 0; i < mass.size(); ++i)
      mass[i] *= std::max(kLeastFactor, 1 + factor.dot(monomials_[i]));
  }
}

}  // namespace springlod
