#include "voxelize/cells/cut_cells.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "voxelize/cells/fractions.hpp"
#include "voxelize/cells/inside.hpp"

namespace springlod::voxelize {

CutCells::CutCells(const CellFrame& frame)
    : frame_(frame), fraction_(frame.count(), 0), nearest_(frame.count()) {}

double CutCells::add(std::uint16_t number, const DistanceField& distance,
                     const DistanceField& halves, const std::vector<std::uint16_t>& owner) {
  const double cells = add_fractions(halves, frame_, fraction_);
  for (std::uint32_t n = 0; n < owner.size(); ++n) {
    if (owner[n] != 0 || fraction_[n] < kLeastFraction) continue;
    const auto here = static_cast<float>(distance_at(distance, frame_.index(n)));
    if (nearest_[n].solid == 0 || here < nearest_[n].distance) nearest_[n] = {here, number};
  }
  return cells;
}

std::vector<float> CutCells::finish(std::vector<std::uint16_t>& owner) && {
  constexpr float kFull = 0.999F;  // a full cell, but for the rounding of its eighths
  for (std::size_t n = 0; n < owner.size(); ++n) {
    if (owner[n] == 0 && fraction_[n] >= kLeastFraction) owner[n] = nearest_[n].solid;
    // A sheet thinner than the least fraction that holds the centre of a cell stays connected.
    fraction_[n] = fraction_[n] > kFull ? 1 : std::max(fraction_[n], float{kLeastFraction});
  }
  return std::move(fraction_);
}

}  // namespace springlod::voxelize
