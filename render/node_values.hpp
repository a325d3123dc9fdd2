#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/scene.hpp"

namespace springlod::render {

/// Maps values to positions on the colour scale, with the label and unit of the scale.
struct ValueScale {
  std::string label;  ///< with the unit: "Young's modulus (MPa)"
  double low = 0;
  double high = 1;
  bool logarithmic = false;
  double unit = 1;  ///< displayed unit, in SI units: 1e6 for MPa

  /// Position of a value: 0 at low, 1 at high, clamped; 1/2 if low equals high.
  double part(double value) const;
  double value(double part) const;
  bool operator==(const ValueScale&) const = default;
};

/// Sets the node colours of all bodies that show values. Bodies with the same label share a scale
/// unless their style sets a range. Returns the scale of each panel; none for panels without
/// values. Throws InputError for invalid ranges and values.
std::vector<std::optional<ValueScale>> colour_by_values(std::vector<Panel>& panels);

/// Whether the balls of the body show values instead of materials.
bool shows_values(const DrawnBody& body);

}  // namespace springlod::render
