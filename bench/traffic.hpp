#pragma once

#include "sim/fast/quads/quad_layout.hpp"
#include "sim/fast/rows/row_layout.hpp"

namespace springlod::bench {

/// Minimum memory traffic of a step if no data stays in a cache between steps: every array of the
/// layout and of the state once [bytes per spring].
struct Traffic {
  double read = 0;     ///< constants, which are only read
  double changed = 0;  ///< positions, velocities, forces: read and written, but counted once
};

template <class Real>
Traffic step_traffic(const sim::QuadLayout<Real>& layout, double springs);
template <class Real>
Traffic step_traffic(const sim::RowLayout<Real>& layout, double springs);

}  // namespace springlod::bench
