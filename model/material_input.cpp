#include "model/material_input.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "base/error.hpp"

namespace springlod::inline model {

void validate(const MaterialInput& input) {
  validate(input.material);
  // At a ratio of 1 (critical damping), the slowest vibration no longer vibrates.
  if (const auto ratio = input.damping_ratio; ratio && !(*ratio >= 0 && *ratio < 1))
    throw InputError(
        fmt::format("material \"{}\": damping_ratio = {} must be a finite number, 0 or more and "
                    "below 1 (1: critical damping); the default is {}",
                    input.material.name, *ratio, kUsualDampingRatio));
}

double lowest_frequency_estimate(double wave_speed, double extent) {
  return std::numbers::pi * wave_speed / extent;
}

Material resolved(const MaterialInput& input, double omega) {
  Material material = input.material;
  if (input.damping_ratio) material.damping = omega > 0 ? 2 * *input.damping_ratio / omega : 0;
  return material;
}

}  // namespace springlod::inline model
