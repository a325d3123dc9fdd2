#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/prefetch.hpp"
#include "lod/grouping/grouping.hpp"

namespace springlod::lod {

inline constexpr double kForbidden = std::numeric_limits<double>::infinity();

/// Keys rounded on access, so that nearly equal keys tie: on a lattice equal lengths differ in
/// their last bits, and rounding errors must not choose the groups. NaN becomes kForbidden. Refers
/// to the keys, which must outlive it.
class RoundedKeys {
 public:
  RoundedKeys() = default;
  explicit RoundedKeys(std::span<const double> keys);
  double operator[](std::size_t i) const;
  void prefetch(std::size_t i) const { springlod::prefetch(&keys_[i]); }

 private:
  std::span<const double> keys_;
  double quantum_ = 0;
};

/// Gradient of each spring: |dE| / mean E + |drho| / mean rho per length [1/m] (the paper, section
/// 5.2; docs/method.md, eq. 22).
std::vector<double> spring_gradients(const MassSpringModel& model);

/// Order of the candidates for a pair, see the table below eq. 22 of docs/method.md.
enum class PairOrder { length, gradient_and_length, gradient_first };

/// Keys for choosing a neighbour: the first key, then the second, then a random number.
class PairKeys {
 public:
  /// `gradient`: the result of spring_gradients; not used by PairOrder::length.
  PairKeys(const MassSpringModel& model, const GroupingOptions& options, PairOrder order,
           std::vector<double> gradient);
  PairKeys(const PairKeys&) = delete;
  PairKeys& operator=(const PairKeys&) = delete;

  double first(std::uint32_t spring) const { return first_[spring]; }
  double second(std::uint32_t spring) const { return has_second_ ? second_[spring] : 0; }
  void prefetch(std::uint32_t spring) const {
    first_.prefetch(spring);
    if (has_second_) second_.prefetch(spring);
  }

 private:
  std::vector<double> own_;  // keys that are not the model's lengths
  RoundedKeys first_;
  RoundedKeys second_;
  bool has_second_ = false;
};

/// Key of each node; nodes are visited in ascending order. Empty: random order.
std::vector<double> visit_priority(const MassSpringModel& model, const GroupingOptions& options,
                                   PairOrder order, const std::vector<double>& gradient);

}  // namespace springlod::lod
