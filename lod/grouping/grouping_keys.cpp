#include "lod/grouping/grouping_keys.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace springlod::lod {
namespace {

// Weight of the gradient relative to the length in the soft key (docs/method.md, eq. 23).
constexpr double kGradientWeight = 4;

// Keys that agree to this fraction of their mean are equal; a random number decides.
constexpr double kTieFraction = 1e-9;

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// Young's modulus of a node up to a common factor: the mean of k weighted by L^2 (docs/method.md,
// eq. 22). A mean has no bias at border nodes, which have fewer springs.
std::vector<double> node_stiffness(const MassSpringModel& m) {
  std::vector<double> work(m.node_count(), 0);
  std::vector<double> weight(m.node_count(), 0);
  for (std::uint32_t s = 0; s < m.spring_count(); ++s) {
    const double l2 = m.rest_length[s] * m.rest_length[s];
    for (const std::uint32_t i : {m.a[s], m.b[s]}) {
      work[i] += m.stiffness[s] * l2;
      weight[i] += l2;
    }
  }
  for (std::uint32_t i = 0; i < m.node_count(); ++i)
    work[i] = weight[i] > 0 ? work[i] / weight[i] : 0;
  return work;
}

// Mean gradient of the springs of each node.
std::vector<double> node_gradients(const MassSpringModel& m, const std::vector<double>& gradient) {
  std::vector<double> mean_of(m.node_count(), 0);
  std::vector<std::uint32_t> springs(m.node_count(), 0);
  for (std::uint32_t s = 0; s < m.spring_count(); ++s)
    for (const std::uint32_t i : {m.a[s], m.b[s]}) {
      mean_of[i] += gradient[s];
      ++springs[i];
    }
  for (std::uint32_t i = 0; i < m.node_count(); ++i) mean_of[i] /= std::max(1U, springs[i]);
  return mean_of;
}

}  // namespace

RoundedKeys::RoundedKeys(std::span<const double> keys) : keys_(keys) {
  double sum = 0;
  std::size_t count = 0;
  for (const double key : keys)
    if (std::isfinite(key)) {
      sum += std::abs(key);
      ++count;
    }
  if (count > 0) quantum_ = kTieFraction * sum / static_cast<double>(count);
}

double RoundedKeys::operator[](std::size_t i) const {
  const double key = keys_[i];
  if (std::isnan(key)) return kForbidden;
  return quantum_ > 0 && std::isfinite(key) ? std::round(key / quantum_) : key;
}

std::vector<double> spring_gradients(const MassSpringModel& m) {
  const std::vector<double> young = node_stiffness(m);
  std::vector<double> density(m.node_count());
  for (std::uint32_t i = 0; i < m.node_count(); ++i) density[i] = m.mass[i] / m.volume[i];
  const double mean_young = mean(young);
  const double mean_density = mean(density);
  std::vector<double> gradient(m.spring_count());
  for (std::uint32_t s = 0; s < m.spring_count(); ++s)
    gradient[s] = (std::abs(young[m.a[s]] - young[m.b[s]]) / mean_young +
                   std::abs(density[m.a[s]] - density[m.b[s]]) / mean_density) /
                  m.rest_length[s];
  return gradient;
}

PairKeys::PairKeys(const MassSpringModel& model, const GroupingOptions& options, PairOrder order,
                   std::vector<double> gradient)
    : own_(std::move(gradient)) {
  if (options.pair_cost) {
    own_.resize(model.spring_count());
    for (std::uint32_t s = 0; s < model.spring_count(); ++s)
      own_[s] = options.pair_cost(model.a[s], model.b[s]);
    first_ = RoundedKeys(own_);
    return;
  }
  switch (order) {
    case PairOrder::length:
      first_ = RoundedKeys(model.rest_length);
      break;
    case PairOrder::gradient_and_length:
      for (std::uint32_t s = 0; s < model.spring_count(); ++s)
        own_[s] = model.rest_length[s] * (1 + kGradientWeight * own_[s] * model.rest_length[s]);
      first_ = RoundedKeys(own_);
      break;
    case PairOrder::gradient_first:
      first_ = RoundedKeys(own_);
      second_ = RoundedKeys(model.rest_length);
      has_second_ = true;
      break;
  }
}

std::vector<double> visit_priority(const MassSpringModel& model, const GroupingOptions& options,
                                   PairOrder order, const std::vector<double>& gradient) {
  if (options.node_priority) {
    std::vector<double> priority(model.node_count());
    for (std::uint32_t i = 0; i < model.node_count(); ++i) priority[i] = options.node_priority(i);
    return priority;
  }
  if (order == PairOrder::length) return {};
  return node_gradients(model, gradient);
}

}  // namespace springlod::lod
