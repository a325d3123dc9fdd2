#pragma once

#include <array>
#include <memory>
#include <vector>

#include <hwy/aligned_allocator.h>

#include "sim/fast/fast_body.hpp"
#include "sim/fast/row_layout.hpp"

namespace springlod {

/// What moves of a body laid out in rows, by place. One array a coordinate, filled up so that a row
/// may be loaded whole anywhere.
template <class Real>
struct RowState {
  using Array = std::vector<Real, hwy::AlignedAllocator<Real>>;
  using Coordinates = std::array<Array, 3>;
  Coordinates x;    ///< [m]
  Coordinates v;    ///< [m/s]
  Coordinates low;  ///< what x is too coarse to hold [m]; single precision only
  /// Forces that a block works out on the places of its own and its reach [N]; by block.
  std::vector<Coordinates> force;
};
