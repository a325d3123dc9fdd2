#pragma once

#include "sim/fast/quad_layout.hpp"
#include "sim/fast/row_layout.hpp"

namespace springlod::bench {

/// What a step of a body must move between memory and core at least, if nothing of it stays in a
/// cache until the next step: every array of the layout and of what moves once [bytes a spring].
struct Traffic {
  double read = 0;     ///< constants: they only come
  double changed = 0;  ///< places, velocities, forces: they come and go, but count once here
};

template <class Real>
Traffic step_traffic(const sim::QuadLayout<Real>& layout, double springs);
template <class Real>
Traffic step_traffic(const sim::RowLayout<Real>& layout, double springs);

}  // namespace springlod::bench
