#pragma once

#include "model/mass_spring.hpp"
#include "sim/fast/quads/quad_layout.hpp"

namespace springlod::sim {

/// Gives the blocks the corners of the model. `layout` must be complete otherwise. False if a block
/// has too many neighbours for its indices.
template <class Real>
bool place_corners(const MassSpringModel& model, QuadLayout<Real>& layout);

}  // namespace springlod::sim
