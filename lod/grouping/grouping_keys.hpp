#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/prefetch.hpp"
#include "lod/grouping/grouping.hpp"

namespace springlod::lod {

inline constexpr double kForbidden = std::numeric_limits<double>::infinity();

/// Keys rounded as they are read, so that ties are ties: on a lattice equal lengths differ in their
/// last bits, and rounding must not choose the groups. NaN reads as forbidden. Refers to the keys.
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

/// g of each spring: |dE| / mean E + |drho| / mean rho per length [1/m] (the paper, section 5.2).
std::vector<double> spring_gradients(const MassSpringModel& model);

/// By what neighbours are chosen.
enum class PairOrder { length, gradient_and_length, gradient_first };

/// What decides between neighbours: first key, then second, then chance.
class PairKeys {
 public:
  /// `gradient` as spring_gradients tells; not needed for PairOrder::length.
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

/// Key of each node, lower goes first; empty if chance alone decides.
std::vector<double> visit_priority(const MassSpringModel& model, const GroupingOptions& options,
                                   PairOrder order, const std::vector<double>& gradient);

}  // namespace springlod::lod
