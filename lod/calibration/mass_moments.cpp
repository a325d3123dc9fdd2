#include "lod/calibration/mass_moments.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include <Eigen/QR>

#include "model/material_regions.hpp"

namespace springlod::lod {
namespace {

/// Least factor on a mass in one correction.
constexpr double kLeastFactor = 0.2;
/// Passes of the correction. It is linear in the masses, so one pass would suffice without rounding
/// errors and kLeastFactor.
constexpr int kCorrections = 3;

/// Least number of nodes of a material region with its own constraints: twice its ten moments. In a
/// smaller region the constraints would nearly fix the masses.
constexpr std::size_t kLeastPiece = 20;

/// The nodes of each large material region, then those of all small regions together.
std::vector<std::vector<std::uint32_t>> pieces_of(const MassSpringModel& model) {
  std::vector<std::vector<std::uint32_t>> pieces = material_regions(model);
  const auto small = std::stable_partition(
      pieces.begin(), pieces.end(), [](const auto& nodes) { return nodes.size() >= kLeastPiece; });
  std::vector<std::uint32_t> rest;
  for (auto piece = small; piece != pieces.end(); ++piece)
    rest.insert(rest.end(), piece->begin(), piece->end());
  pieces.erase(small, pieces.end());
  if (!rest.empty()) pieces.push_back(std::move(rest));
  return pieces;
}

}  // namespace

MassMoments::MassMoments(const MassSpringModel& model, KeptMoments kept) {
  const Box3 box = bounds(model.rest);
  const double scale = box.diagonal().norm() > 0 ? 2 / box.diagonal().norm() : 1;
  for (const Vec3& place : model.rest) {
    const Vec3 x = scale * (place - box.center());
    monomials_.emplace_back() << 1, x, x.cwiseAbs2(), x.x() * x.y(), x.x() * x.z(), x.y() * x.z();
  }
  if (kept == KeptMoments::pieces) {
    for (std::vector<std::uint32_t>& nodes : pieces_of(model))
      pieces_.push_back({std::move(nodes)});
  } else {
    pieces_.emplace_back().nodes.resize(model.node_count());
    std::iota(pieces_[0].nodes.begin(), pieces_[0].nodes.end(), 0U);
  }
  for (Piece& piece : pieces_)
    for (const std::uint32_t i : piece.nodes) piece.target += model.mass[i] * monomials_[i];
}

void MassMoments::project(const std::vector<double>& mass,
                          Eigen::Ref<Eigen::MatrixXd> changes) const {
  for (const Piece& piece : pieces_) {
    const auto size = static_cast<Eigen::Index>(piece.nodes.size());
    Eigen::Matrix<double, Eigen::Dynamic, 10> gradients(size, 10);
    for (Eigen::Index i = 0; i < size; ++i) {
      const std::uint32_t node = piece.nodes[static_cast<std::size_t>(i)];
      gradients.row(i) = mass[node] * monomials_[node].transpose();
    }
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(gradients);
    Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(size, qr.rank());
    basis = qr.householderQ() * basis;
    const Eigen::MatrixXd of_piece = changes(piece.nodes, Eigen::all);
    changes(piece.nodes, Eigen::all) -= basis * (basis.transpose() * of_piece).eval();
  }
}

void MassMoments::restore(std::vector<double>& mass) const {
  for (const Piece& piece : pieces_) restore(piece, mass);
}

void MassMoments::restore(const Piece& piece, std::vector<double>& mass) const {
  for (int pass = 0; pass < kCorrections; ++pass) {
    Eigen::Matrix<double, 10, 10> response = Eigen::Matrix<double, 10, 10>::Zero();
    Moments missing = piece.target;
    for (const std::uint32_t i : piece.nodes) {
      response += mass[i] * monomials_[i] * monomials_[i].transpose();
      missing -= mass[i] * monomials_[i];
    }
    const Moments factor = response.completeOrthogonalDecomposition().solve(missing);
    for (const std::uint32_t i : piece.nodes)
      mass[i] *= std::max(kLeastFactor, 1 + factor.dot(monomials_[i]));
  }
}

}  // namespace springlod::lod
