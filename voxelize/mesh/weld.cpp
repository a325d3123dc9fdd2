#include "voxelize/mesh/weld.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

namespace springlod::voxelize {
namespace {

// Fraction of the bounding diagonal below which two vertices are merged: some 10 times the rounding
// of single precision, far below any detail that a grid of cells resolves.
constexpr double kWeldTolerance = 1e-6;
// Side of a hash cell in tolerances: large enough that few points are near two cells, small enough
// that few points share a cell.
constexpr double kHashCell = 64;
// Bits of a hash cell's index along one axis: there are some 1 / (64 * 1e-6) = 15625 cells.
constexpr unsigned kCellBits = 16;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

using HashCell = std::array<std::uint32_t, 3>;

/// Vertices that are not merged with a lower one, by their hash cell.
class KeptVertices {
 public:
  explicit KeptVertices(std::size_t vertices)
      : slots_(std::bit_ceil(2 * vertices + 2)), next_(vertices, kNone) {}

  void add(const HashCell& cell, std::uint32_t v) {
    Slot& slot = slot_of(key_of(cell));
    slot.key = key_of(cell);
    next_[v] = slot.first;
    slot.first = v;
  }
  template <typename Visit>
  void for_each_in(const HashCell& cell, Visit visit) {
    for (std::uint32_t v = slot_of(key_of(cell)).first; v != kNone; v = next_[v]) visit(v);
  }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t first = kNone;  // kNone: the slot is free
  };

  static std::uint64_t key_of(const HashCell& cell) {
    std::uint64_t key = 0;
    for (const std::uint32_t c : cell) key = (key << kCellBits) | c;
    return key;
  }
  /// The slot of a key, or the free slot where it belongs (linear probing; at most half are used).
  Slot& slot_of(std::uint64_t key) {
    // Knuth's multiplicative hashing with 2^64 over the golden ratio: the high bits are well mixed.
    constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15;
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = (key * kGolden) >> (64 - std::countr_zero(slots_.size()));
    while (slots_[at].first != kNone && slots_[at].key != key) at = (at + 1) & mask;
    return slots_[at];
  }

  std::vector<Slot> slots_;
  std::vector<std::uint32_t> next_;  // next vertex of the same cell, kNone after the last
};

class Welder {
 public:
  explicit Welder(const TriangleMesh& mesh) : mesh_(mesh), kept_(mesh.positions.size()) {
    const Box3 box = bounds(mesh);
    tolerance_ = kWeldTolerance * box.diagonal().norm();
    cells_per_metre_ = 1 / (kHashCell * tolerance_);
    low_ = box.min() - Vec3::Constant(tolerance_);
  }

  std::uint32_t weld(std::uint32_t v) {
    if (tolerance_ == 0) return 0;  // all vertices at one place
    const Vec3& p = mesh_.positions[v];
    const HashCell from = cell_of(p - Vec3::Constant(tolerance_));
    const HashCell to = cell_of(p + Vec3::Constant(tolerance_));
    std::uint32_t nearest = v;
    HashCell cell{};
    for (cell[2] = from[2]; cell[2] <= to[2]; ++cell[2])
      for (cell[1] = from[1]; cell[1] <= to[1]; ++cell[1])
        for (cell[0] = from[0]; cell[0] <= to[0]; ++cell[0])
          kept_.for_each_in(cell, [&](std::uint32_t w) {
            if ((mesh_.positions[w] - p).squaredNorm() <= tolerance_ * tolerance_)
              nearest = std::min(nearest, w);
          });
    if (nearest == v) kept_.add(cell_of(p), v);
    return nearest;
  }

 private:
  // No point lies below `low_` except by rounding, so truncation rounds down, and a value slightly
  // below 0 becomes 0 too.
  HashCell cell_of(const Vec3& p) const {
    HashCell cell{};
    for (int d = 0; d < 3; ++d)
      cell[d] = static_cast<std::uint32_t>(
          static_cast<std::int32_t>((p[d] - low_[d]) * cells_per_metre_));
    return cell;
  }

  const TriangleMesh& mesh_;
  double tolerance_;        // [m]
  double cells_per_metre_;  // hash cells
  Vec3 low_;                // of the first hash cell [m]
  KeptVertices kept_;
};

}  // namespace

std::vector<std::uint32_t> weld_vertices(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> welded(mesh.positions.size());
  Welder welder(mesh);
  for (std::uint32_t v = 0; v < welded.size(); ++v) welded[v] = welder.weld(v);
  return welded;
}

}  // namespace springlod::voxelize
