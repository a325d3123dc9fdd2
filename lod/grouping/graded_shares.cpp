#include "lod/grouping/graded_shares.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"

namespace springlod::lod {
namespace {

/// Least share of a kind relative to the proportional share; the largest is its inverse.
constexpr double kLeastFraction = 0.5;
/// Number of groups that is enough to resolve the shape of a kind.
constexpr double kShape = 24;

double sum(const std::vector<double>& shares) {
  double all = 0;
  for (const double share : shares) all += share;
  return all;
}

/// Shares before rounding: nodes * weight * scale within bounds; the scale is found by bisection.
std::vector<double> exact_shares(const std::vector<NodeKind>& kinds, double count, double all,
                                 double grading) {
  const double even = count / all;
  constexpr double kVolumeOfFrequency = -1.5;  // the squared frequency scales as n^(-2/3)
  std::vector<double> weight;
  for (const NodeKind& kind : kinds)
    weight.push_back(kind.squared_frequency > 0
                         ? std::pow(kind.squared_frequency, kVolumeOfFrequency * grading)
                         : 1);
  const auto shares = [&](double scale) {
    std::vector<double> share;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const double nodes = kinds[k].nodes;
      const double least = std::min(even, std::max(kLeastFraction * even, kShape / nodes));
      const double most = std::min(1.0, even / kLeastFraction);
      share.push_back(nodes * std::clamp(weight[k] * scale, least, most));
    }
    return share;
  };
  const auto [lightest, heaviest] = std::minmax_element(weight.begin(), weight.end());
  double low = kLeastFraction * even / *heaviest;
  double high = 1 / *lightest;
  constexpr int kHalvings = 100;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = std::sqrt(low * high);
    (sum(shares(middle)) < count ? low : high) = middle;
  }
  return shares(high);
}

}  // namespace

std::vector<std::uint32_t> graded_shares(const std::vector<NodeKind>& kinds, std::uint32_t count,
                                         double grading) {
  std::size_t all = 0;
  for (const NodeKind& kind : kinds) all += kind.nodes;
  if (count < kinds.size() || count > all)
    throw InputError(fmt::format(
        "compact grouping: {} groups are impossible for {} nodes of {} kinds (components, "
        "materials, weak borders), which cannot share groups; use {} to {}",
        count, all, kinds.size(), kinds.size(), all));
  if (!(grading >= 0 && grading <= 1))
    throw InputError(fmt::format("compact grouping: grading = {} must be from 0 to 1", grading));
  if (kinds.empty()) return {};
  const std::vector<double> exact = exact_shares(kinds, count, static_cast<double>(all), grading);
  // Largest remainders first.
  std::vector<std::uint32_t> share;
  std::vector<std::pair<double, std::size_t>> rest;
  std::uint32_t given = 0;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    share.push_back(std::max(1U, static_cast<std::uint32_t>(exact[k])));
    rest.emplace_back(share.back() - exact[k], k);
    given += share.back();
  }
  std::sort(rest.begin(), rest.end());
  for (std::size_t r = 0; given < count; r = (r + 1) % rest.size())
    if (std::uint32_t& more = share[rest[r].second]; more < kinds[rest[r].second].nodes) {
      ++more;
      ++given;
    }
  for (std::size_t r = rest.size(); given > count; r = r > 1 ? r - 1 : rest.size())
    if (std::uint32_t& less = share[rest[r - 1].second]; less > 1) {
      --less;
      --given;
    }
  return share;
}

}  // namespace springlod::lod
