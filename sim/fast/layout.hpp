#pragma once

#include "base/choice.hpp"

namespace springlod::sim {

/// Memory layout of the springs of a model.
enum class Layout {
  fastest,   ///< rows for a lattice, quads otherwise
  any_shape  ///< always quads, so that all bodies are timed with the same kernel
};

inline constexpr Choice<Layout> kLayouts[] = {
    {Layout::fastest, "fastest", "rows for a lattice, quads for any other model"},
    {Layout::any_shape, "any shape",
     "quads for a lattice too, to time a lattice and its levels by one kernel"}};
constexpr ChoiceTable<Choice<Layout>> choices(Layout) {
  return {"layout", kLayouts};
}

/// Floating-point type of a run: float or double.
enum class Precision { single_precision, double_precision };

inline constexpr Choice<Precision> kPrecisions[] = {
    {Precision::double_precision, "double", "64 bits"},
    {Precision::single_precision, "single",
     "32 bits: a step takes some two thirds of the time, docs/precision.md tells what it costs"}};
constexpr ChoiceTable<Choice<Precision>> choices(Precision) {
  return {"precision", kPrecisions};
}

}  // namespace springlod::sim
