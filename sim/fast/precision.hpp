#pragma once

#include "base/choice.hpp"

namespace springlod {

/// Of the numbers that a run is made with: float or double.
enum class Precision { single_precision, double_precision };

inline constexpr Choice<Precision> kPrecisions[] = {
    {Precision::double_precision, "double", "64 bits"},
    {Precision::single_precision, "single",
     "32 bits: a step takes some two thirds of the time, docs/precision.md tells what it costs"}};
constexpr ChoiceTable<Choice<Precision>> choices(Precision) {
  return {"precision", kPrecisions};
}

}  // namespace springlod
