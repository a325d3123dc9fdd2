#pragma once

#include "model/mass_spring.hpp"
#include "sim/fast/rows/row_layout.hpp"

namespace springlod::sim {

/// Groups the corners of the model into stars. `layout` must have its blocks and places.
template <class Real>
RowCorners<Real> place_corners(const MassSpringModel& model, const RowLayout<Real>& layout);

}  // namespace springlod::sim
