#pragma once

#include <cstdint>
#include <vector>

#include "voxelize/cells/frame.hpp"
#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// The fractions of the cells of a frame that are inside any of several solids, added one by one.
class CutCells {
 public:
  explicit CutCells(const CellFrame& frame);
  /// `number`: above 0; `distance`, `halves`: level sets in cells and in half cells (halved()).
  /// `owner`: the solid that holds the centre of each cell, 0 for none. Returns the solid's volume
  /// [cells].
  double add(std::uint16_t number, const DistanceField& distance, const DistanceField& halves,
             const std::vector<std::uint16_t>& owner);
  /// Gives each cut cell without an owner to the solid whose surface is nearest to its centre.
  /// Returns the fraction of each cell of the frame [1]. What several solids fill counts once.
  std::vector<float> finish(std::vector<std::uint16_t>& owner) &&;

 private:
  struct Nearest {
    float distance = 0;  // [m]
    std::uint16_t solid = 0;
  };

  CellFrame frame_;
  std::vector<float> fraction_;
  std::vector<Nearest> nearest_;
};

/// Memory that CutCells takes for each cell of its frame [bytes].
inline constexpr double kBytesPerCutCell = 12;

}  // namespace springlod::voxelize
