#pragma once

namespace springlod {

/// Of the numbers that a run is made with: float or double.
enum class Precision { single_precision, double_precision };

}  // namespace springlod
