#include "model/asset/slim_asset.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/QR>
#include <fmt/format.h>

#include "base/error.hpp"

namespace springlod::inline model {
namespace {

// Largest error of a point after a correction of weights, as a fraction of the row's width [1].
constexpr double kExact = 1e-9;
// Largest weight that a correction may make, over the largest before [1].
constexpr double kMostGrowth = 1.25;
// A spring has no force at rest if its length and the distance of its ends differ by less [1].
constexpr double kSameLength = 1e-9;
constexpr double kLargestInteger = 32767;
constexpr int kMostBits = 14;  // of the unit of weights: half of the range is kept for weights of 2

/// g++ 12 at -O3 would drop both conversions of two numbers that it treats as one vector, but not
/// the store to a volatile variable.
double single(double value) {
  const volatile float rounded = static_cast<float>(value);
  return static_cast<double>(rounded);
}

Vec3 single(const Vec3& v) {
  return {single(v.x()), single(v.y()), single(v.z())};
}

template <class T>
void round_all(std::vector<T>& values) {
  for (T& value : values) value = single(value);
}

/// Rows 1, x, y, z of the nodes, relative to their mean and over their width.
Eigen::Matrix4Xd affine_rows(const std::vector<std::uint32_t>& nodes,
                             const std::vector<Vec3>& rest) {
  Vec3 mean = Vec3::Zero();
  for (const std::uint32_t node : nodes) mean += rest[node] / static_cast<double>(nodes.size());
  double width = 0;
  for (const std::uint32_t node : nodes) width = std::max(width, (rest[node] - mean).norm());
  Eigen::Matrix4Xd rows(4, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t j = 0; j < nodes.size(); ++j)
    rows.col(static_cast<Eigen::Index>(j)) << 1,
        (rest[nodes[j]] - mean) / (width > 0 ? width : 1.0);
  return rows;
}

/// Drops the small weights of a row; false, and the row as it was, if the others cannot make up for
/// them.
bool drop_small(std::vector<std::uint32_t>& nodes, Eigen::VectorXd& weights,
                const std::vector<Vec3>& rest) {
  const Eigen::Matrix4Xd rows = affine_rows(nodes, rest);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index j = 0; j < weights.size(); ++j)
    if (std::abs(weights[j]) >= kLeastSlimWeight) kept.push_back(j);
  if (kept.empty() || static_cast<Eigen::Index>(kept.size()) == weights.size()) return false;
  const Eigen::Matrix4Xd kept_rows = rows(Eigen::all, kept);
  const Eigen::VectorXd before = weights(kept);
  const Eigen::Vector4d missing = rows * weights - kept_rows * before;
  const Eigen::VectorXd changed =
      before + kept_rows.completeOrthogonalDecomposition().solve(missing);
  if ((kept_rows * changed - rows * weights).norm() > kExact ||
      changed.lpNorm<Eigen::Infinity>() > kMostGrowth * weights.lpNorm<Eigen::Infinity>())
    return false;
  std::vector<std::uint32_t> left;
  for (const Eigen::Index j : kept) left.push_back(nodes[static_cast<std::size_t>(j)]);
  nodes = std::move(left);
  weights = changed;
  return true;
}

/// Multiples of the unit that add up to exactly 1. The largest weight takes what rounding leaves.
void round_weights(Binding& binding, double unit) {
  for (std::uint32_t p = 0; p < binding.point_count(); ++p) {
    const auto begin = binding.weight.begin() + binding.start[p];
    const auto end = binding.weight.begin() + binding.start[p + 1];
    if (begin == end) continue;
    double left = 1;
    for (auto w = begin; w != end; ++w) left -= * w = std::round(*w / unit) * unit;
    *std::max_element(begin, end) += left;
  }
}

void slim_dilatation(MassSpringModel& model) {
  DilatationTerms& terms = model.dilatation;
  round_all(terms.modulus);
  round_all(terms.damping_time);
  for (std::uint32_t t = 0; t < terms.count(); ++t) {
    // The rest positions have moved by their rounding.
    const std::uint32_t first = terms.start[t];
    const std::uint32_t last = terms.start[t + 1];
    Mat3 unit = Mat3::Zero();
    for (std::uint32_t e = first; e < last; ++e)
      unit += (model.rest[terms.node[e]] - model.rest[terms.node[first]]) *
              terms.gradient[e].transpose();
    const Mat3 correction = unit.inverse().transpose();
    for (std::uint32_t e = first; e < last; ++e)
      terms.gradient[e] = single(Vec3(correction * terms.gradient[e]));
  }
}

void slim_model(MassSpringModel& model) {
  const auto distance = [&](std::uint32_t s) {
    return (model.rest[model.b[s]] - model.rest[model.a[s]]).norm();
  };
  bool at_rest = true;  // all springs
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    at_rest = at_rest && std::abs(model.rest_length[s] / distance(s) - 1) < kSameLength;
  const std::vector<Vec3> exact = model.rest;
  round_all(model.rest);
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    model.rest_length[s] = at_rest ? distance(s) : single(model.rest_length[s]);
  round_all(model.mass);
  round_all(model.volume);
  round_all(model.contact_area);
  round_all(model.stiffness);
  round_all(model.damping);
  for (Corner& corner : model.corners) corner.young = single(corner.young);
  settle_corners(model.corners, model.rest);
  slim_dilatation(model);
  ContactSurface& surface = model.surface;
  if (surface.empty()) return;
  surface.of_nodes = slim_binding(surface.of_nodes, exact);
  round_all(surface.normal);
  round_all(surface.area);
  round_all(surface.stiffness);
}

}  // namespace

double weight_unit(const std::vector<double>& weights, double room) {
  double largest = 1;
  for (const double weight : weights) largest = std::max(largest, std::abs(weight));
  int bits = kMostBits;
  while (bits > 0 && std::ldexp(largest, bits) + room > kLargestInteger) --bits;
  return std::ldexp(1.0, -bits);
}

Binding slim_binding(const Binding& binding, const std::vector<Vec3>& rest) {
  Binding slim;
  if (binding.start.empty()) return slim;
  slim.start.push_back(0);
  std::uint32_t longest = 0;
  for (std::uint32_t p = 0; p < binding.point_count(); ++p) {
    const auto first = static_cast<std::ptrdiff_t>(binding.start[p]);
    const auto last = static_cast<std::ptrdiff_t>(binding.start[p + 1]);
    std::vector<std::uint32_t> nodes(binding.node.begin() + first, binding.node.begin() + last);
    Eigen::VectorXd weights = Eigen::VectorXd::Map(binding.weight.data() + first, last - first);
    drop_small(nodes, weights, rest);
    slim.node.insert(slim.node.end(), nodes.begin(), nodes.end());
    slim.weight.insert(slim.weight.end(), weights.begin(), weights.end());
    slim.start.push_back(static_cast<std::uint32_t>(slim.node.size()));
    longest = std::max(longest, slim.start[p + 1] - slim.start[p]);
  }
  // What rounding leaves of a row is at most half a unit an entry.
  round_weights(slim, weight_unit(slim.weight, longest));
  return slim;
}

LodAsset slimmed(const LodAsset& asset) {
  validate(asset);
  LodAsset slim = asset;
  if (!slim.surface_of_base.start.empty())
    slim.surface_of_base = slim_binding(asset.surface_of_base, asset.chain.levels[0].model.rest);
  for (Level& level : slim.chain.levels) {
    slim_model(level.model);
    level.certificate.reset();
  }
  round_all(slim.surface.positions);
  slim.provenance.set("slim", fmt::format("single precision, weights below {} dropped, no "
                                          "certificates",
                                          kLeastSlimWeight));
  try {
    validate(slim);
  } catch (const InputError& e) {
    throw InputError(
        fmt::format("in the single precision of a slim asset, {}; save it whole, or "
                    "move the body to the origin and use larger cells",
                    e.what()));
  }
  return slim;
}

}  // namespace springlod::inline model
