#include "sim/study/deviation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/SVD>

namespace springlod::sim {
namespace {

// Frames of two runs closer than this are the same instant [s]; frame times only differ by
// rounding.
constexpr double kSameTime = 1e-9;

Vec3 center(const std::vector<Vec3>& p, const std::vector<double>& mass, double total) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < p.size(); ++i) sum += mass[i] * p[i];
  return sum / total;
}

}  // namespace

double rms_distance(const std::vector<Vec3>& p, const std::vector<Vec3>& q,
                    const std::vector<double>& mass) {
  double sum = 0;
  double total = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    sum += mass[i] * (p[i] - q[i]).squaredNorm();
    total += mass[i];
  }
  return std::sqrt(sum / total);
}

double rms_distance_after_fit(const std::vector<Vec3>& p, const std::vector<Vec3>& q,
                              const std::vector<double>& mass) {
  const double total = std::accumulate(mass.begin(), mass.end(), 0.0);
  const Vec3 center_p = center(p, mass, total);
  const Vec3 center_q = center(q, mass, total);
  Mat3 covariance = Mat3::Zero();
  for (std::size_t i = 0; i < p.size(); ++i)
    covariance += mass[i] * (p[i] - center_p) * (q[i] - center_q).transpose();
  const Eigen::JacobiSVD<Mat3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const bool mirrors = (svd.matrixV() * svd.matrixU().transpose()).determinant() < 0;
  const Vec3 signs(1, 1, mirrors ? -1 : 1);
  const Mat3 rotation = svd.matrixV() * signs.asDiagonal() * svd.matrixU().transpose();
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    sum += mass[i] * (rotation * (p[i] - center_p) - (q[i] - center_q)).squaredNorm();
  return std::sqrt(sum / total);
}

std::vector<Deviation> deviation_over_time(const std::vector<Frame>& frames,
                                           const std::vector<Frame>& base,
                                           const std::vector<double>& mass) {
  std::vector<Deviation> list;
  for (std::size_t f = 0; f < std::min(frames.size(), base.size()); ++f) {
    if (std::abs(frames[f].time - base[f].time) > kSameTime) break;  // one run was stopped here
    list.push_back({frames[f].time, rms_distance(frames[f].x, base[f].x, mass),
                    rms_distance_after_fit(frames[f].x, base[f].x, mass)});
  }
  return list;
}

}  // namespace springlod::sim
