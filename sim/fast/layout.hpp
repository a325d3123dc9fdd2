#pragma once

namespace springlod::sim {

/// How the springs of a model are laid out for speed.
enum class Layout {
  fastest,   ///< in rows if it is a lattice, in quads if not
  any_shape  ///< in quads whatever it is: so that bodies are timed by one kernel
};

/// Of the numbers that a run is made with: float or double.
enum class Precision { single_precision, double_precision };

}  // namespace springlod::sim
