#pragma once

#include "base/choice.hpp"

namespace springlod::sim {

/// Memory layout of the springs of a model for fast steps.
enum class Layout {
  fastest,   ///< rows for a lattice, quads for any other model
  any_shape  ///< quads for every model, so that one kernel times all bodies
};

inline constexpr Choice<Layout> kLayouts[] = {
    {Layout::fastest, "fastest", "rows for a lattice, quads for any other model"},
    {Layout::any_shape, "any shape",
     "quads for a lattice too, so that one kernel times a lattice and its levels"}};
constexpr ChoiceTable<Choice<Layout>> choices(Layout) {
  return {"layout", kLayouts};
}

/// Floating-point type of a run: float or double.
enum class Precision { single_precision, double_precision };

inline constexpr Choice<Precision> kPrecisions[] = {
    {Precision::double_precision, "double", "64 bits"},
    {Precision::single_precision, "single",
     "32 bits: a step takes about two thirds of the time; see docs/precision.md for the error"}};
constexpr ChoiceTable<Choice<Precision>> choices(Precision) {
  return {"precision", kPrecisions};
}

}  // namespace springlod::sim
