#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/scene.hpp"

namespace springlod::render {

/// From numbers to parts of the colour scale, and what is written beside it.
struct ValueScale {
  std::string label;  ///< with the unit: "Young's modulus (MPa)"
  double low = 0;
  double high = 1;
  bool logarithmic = false;
  double unit = 1;  ///< numbers are written in this many of their own unit

  /// 0 at low, 1 at high, clamped beyond; 1/2 if all is one value.
  double part(double value) const;
  double value(double part) const;
  bool operator==(const ValueScale&) const = default;
};

/// Gives every body that shows values the colours of its nodes, on one scale for all bodies with
/// the same label unless their style sets a range. Returns the scale of each panel, if it shows
/// values. Throws InputError for a range or values that no scale can show.
std::vector<std::optional<ValueScale>> colour_by_values(std::vector<Panel>& panels);

/// Whether the balls of the body tell a number and not a material.
bool shows_values(const DrawnBody& body);

}  // namespace springlod::render
