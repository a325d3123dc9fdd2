#include <algorithm>
#include <cmath>
#include <limits>

#include "lod/merging/merge.hpp"
#include "model/point_bins.hpp"

namespace springlod::lod {
namespace {

// Offset of a piece from the centre of its cube along each axis, in edge lengths.
constexpr double kPieceOffset = 0.25;
constexpr std::size_t kPieces = 8;

struct Pieces {
  std::vector<Vec3> at;                ///< centres, eight for each base node [m]
  std::vector<std::uint32_t> nearest;  ///< coarse node of each
};

Pieces cut(const MassSpringModel& base) {
  Pieces pieces;
  for (std::uint32_t i = 0; i < base.node_count(); ++i) {
    const double offset = kPieceOffset * std::cbrt(base.volume[i]);
    for (unsigned corner = 0; corner < kPieces; ++corner) {
      const Vec3 side((corner & 1U) != 0 ? 1 : -1, (corner & 2U) != 0 ? 1 : -1,
                      (corner & 4U) != 0 ? 1 : -1);
      pieces.at.emplace_back(base.rest[i] + offset * side);
    }
  }
  return pieces;
}

void find_nearest(const MassSpringModel& coarse, Pieces& pieces) {
  const Box3 box = bounds(pieces.at).merged(bounds(coarse.rest));
  const PointBins bins(coarse.rest, box, box.sizes().norm() / std::cbrt(coarse.node_count()));
  for (const Vec3& p : pieces.at) pieces.nearest.push_back(bins.nearest(p).point);
}

/// Gives each node without a piece the nearest piece among those of nodes with more than one.
void leave_none_empty(const MassSpringModel& coarse, Pieces& pieces) {
  std::vector<std::uint32_t> owned(coarse.node_count(), 0);
  for (const std::uint32_t n : pieces.nearest) ++owned[n];
  for (std::uint32_t n = 0; n < coarse.node_count(); ++n) {
    if (owned[n] > 0) continue;
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t p = 0; p < pieces.at.size(); ++p) {
      const double squared = (pieces.at[p] - coarse.rest[n]).squaredNorm();
      if (owned[pieces.nearest[p]] < 2 || squared >= least) continue;
      best = p;
      least = squared;
    }
    --owned[pieces.nearest[best]];
    pieces.nearest[best] = n;
    owned[n] = 1;
  }
}

}  // namespace

void share_by_proximity(const MassSpringModel& base, MassSpringModel& coarse) {
  Pieces pieces = cut(base);
  find_nearest(coarse, pieces);
  leave_none_empty(coarse, pieces);
  std::fill(coarse.mass.begin(), coarse.mass.end(), 0);
  std::fill(coarse.volume.begin(), coarse.volume.end(), 0);
  for (std::size_t p = 0; p < pieces.at.size(); ++p) {
    coarse.mass[pieces.nearest[p]] += base.mass[p / kPieces] / kPieces;
    coarse.volume[pieces.nearest[p]] += base.volume[p / kPieces] / kPieces;
  }
}

}  // namespace springlod::lod
