#pragma once

#include "base/choice.hpp"

namespace springlod::sim {

/// How the springs of a model are laid out for speed.
enum class Layout {
  fastest,   ///< in rows if it is a lattice, in quads if not
  any_shape  ///< in quads whatever it is: so that bodies are timed by one kernel
};

inline constexpr Choice<Layout> kLayouts[] = {
    {Layout::fastest, "fastest", "rows for a lattice, quads for any other model"},
    {Layout::any_shape, "any shape",
     "quads for a lattice too, to time a lattice and its levels by one kernel"}};
constexpr ChoiceTable<Choice<Layout>> choices(Layout) {
  return {"layout", kLayouts};
}

/// Of the numbers that a run is made with: float or double.
enum class Precision { single_precision, double_precision };

inline constexpr Choice<Precision> kPrecisions[] = {
    {Precision::double_precision, "double", "64 bits"},
    {Precision::single_precision, "single",
     "32 bits: a step takes some two thirds of the time, docs/precision.md tells what it costs"}};
constexpr ChoiceTable<Choice<Precision>> choices(Precision) {
  return {"precision", kPrecisions};
}

}  // namespace springlod::sim
