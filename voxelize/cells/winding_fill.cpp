#include "voxelize/cells/winding_fill.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace springlod::voxelize {
namespace {

constexpr double kInside = 0.5;  // winding number above which a point is inside [1]
// Side of the blocks of cells that are filled at once where the surface is far [cells].
constexpr std::int32_t kBlock = 8;
// The winding number is harmonic away from the surface, so in a block without surface it lies
// between its values on the boundary. A block whose corners are all this far from kInside, on one
// side, is full or empty [1].
constexpr double kClear = 0.2;

class Filler {
 public:
  Filler(const WindingNumber& surface, const CellFrame& frame)
      : surface_(surface), frame_(frame), inside_(frame.count(), 0) {
    for (std::size_t d = 0; d < 3; ++d) blocks_.size[d] = (frame.size[d] + kBlock - 1) / kBlock;
    near_.assign(blocks_.count(), 0);
  }

  // Blocks that a triangle may touch.
  void mark(const Vec3& a, const Vec3& b, const Vec3& c) {
    CellIndex low{};
    CellIndex high{};
    for (int d = 0; d < 3; ++d) {
      const double first = std::min({a[d], b[d], c[d]}) - 1;
      const double last = std::max({a[d], b[d], c[d]}) + 1;
      const auto end = static_cast<double>(frame_.size[d] - 1);
      low[d] = static_cast<std::int32_t>(std::clamp(std::floor(first), 0.0, end)) / kBlock;
      high[d] = static_cast<std::int32_t>(std::clamp(std::ceil(last), 0.0, end)) / kBlock;
    }
    CellIndex block{};
    for (block[2] = low[2]; block[2] <= high[2]; ++block[2])
      for (block[1] = low[1]; block[1] <= high[1]; ++block[1])
        for (block[0] = low[0]; block[0] <= high[0]; ++block[0]) near_[blocks_.number(block)] = 1;
  }

  std::vector<CellIndex> fill() {
    using Range = tbb::blocked_range<std::uint32_t>;
    tbb::parallel_for(Range(0, blocks_.count()), [&](const Range& range) {
      for (std::uint32_t b = range.begin(); b != range.end(); ++b) fill_block(b);
    });
    std::vector<CellIndex> cells;
    for (std::uint32_t n = 0; n < inside_.size(); ++n)
      if (inside_[n] != 0) cells.push_back(frame_.index(n));
    return cells;
  }

 private:
  double at(const CellIndex& c) const { return surface_.at(Vec3(c[0], c[1], c[2])); }

  void fill_block(std::uint32_t number) {
    const CellIndex block = blocks_.index(number);
    CellIndex low{};
    CellIndex high{};  // within the block
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = block[d] * kBlock;
      high[d] = std::min(low[d] + kBlock, frame_.size[d]) - 1;
    }
    const int uniform = near_[number] != 0 ? 0 : uniform_sign(low, high);
    CellIndex c{};
    for (c[2] = low[2]; c[2] <= high[2]; ++c[2])
      for (c[1] = low[1]; c[1] <= high[1]; ++c[1])
        for (c[0] = low[0]; c[0] <= high[0]; ++c[0]) {
          const bool inside = uniform != 0 ? uniform > 0 : at(c) > kInside;
          inside_[frame_.number(c)] = inside ? 1 : 0;
        }
  }

  // 1: full, -1: empty, 0: not certain.
  int uniform_sign(const CellIndex& low, const CellIndex& high) const {
    double least = 1e300;
    double most = -1e300;
    for (int corner = 0; corner < 8; ++corner) {
      const double w =
          at({(corner & 1) != 0 ? high[0] : low[0], (corner & 2) != 0 ? high[1] : low[1],
              (corner & 4) != 0 ? high[2] : low[2]});
      least = std::min(least, w);
      most = std::max(most, w);
    }
    if (least > kInside + kClear) return 1;
    return most < kInside - kClear ? -1 : 0;
  }

  const WindingNumber& surface_;
  const CellFrame& frame_;
  CellFrame blocks_;                  // numbers of the blocks
  std::vector<std::uint8_t> near_;    // by block
  std::vector<std::uint8_t> inside_;  // by cell
};

}  // namespace

std::vector<CellIndex> wound_cells(const WindingNumber& surface, const std::vector<Vec3>& positions,
                                   const std::vector<Triangle>& triangles, const CellFrame& frame) {
  Filler filler(surface, frame);
  for (const Triangle& t : triangles)
    filler.mark(positions[t[0]], positions[t[1]], positions[t[2]]);
  return filler.fill();
}

}  // namespace springlod::voxelize
