#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/vec.hpp"

namespace springlod::sim {

/// Records the corners that are inside out at the end of each step.
class InversionLog {
 public:
  struct First {
    std::uint64_t step = 0;  ///< number of the step at its end
    std::uint32_t corner = 0;
    Vec3 place = Vec3::Zero();  ///< of the corner's node [m]
  };

  /// The corners at the end of a step: see StepCorners. `late`: more of them at the end of the step
  /// before. place_of(corner): position of its node [m].
  template <class PlaceOf>
  void note(std::uint64_t step, const std::vector<std::uint32_t>& now,
            const std::vector<std::uint32_t>& late, const PlaceOf& place_of) {
    if (!late.empty()) add(step - 1, last_ + late.size(), late, place_of);
    if (!now.empty()) add(step, now.size(), now, place_of);
    last_ = now.size();
  }

  const std::optional<First>& first() const { return first_; }
  /// Largest number at one time.
  std::uint32_t most() const { return most_; }

 private:
  template <class PlaceOf>
  void add(std::uint64_t step, std::size_t count, const std::vector<std::uint32_t>& inverted,
           const PlaceOf& place_of) {
    most_ = std::max(most_, static_cast<std::uint32_t>(count));
    if (first_) return;
    const std::uint32_t corner = *std::min_element(inverted.begin(), inverted.end());
    first_ = First{step, corner, place_of(corner)};
  }

  std::optional<First> first_;
  std::uint32_t most_ = 0;
  std::size_t last_ = 0;  // at the end of the last step
};

}  // namespace springlod::sim
