// What is read off a block of rows between steps. Included once for every vector target; see
// Highway's foreach_target.h.
#if defined(SPRINGLOD_ROW_LOOK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPRINGLOD_ROW_LOOK_INL
#undef SPRINGLOD_ROW_LOOK_INL
#else
#define SPRINGLOD_ROW_LOOK_INL
#endif

#include <algorithm>
#include <cmath>
#include <limits>

#include <hwy/highway.h>

#include "sim/fast/look/corner_margin.hpp"
#include "sim/fast/look/stretch-inl.hpp"
#include "sim/fast/row_vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace springlod::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class D>
HWY_INLINE Vector3<D> cross(const Vector3<D>& p, const Vector3<D>& q) {
  return {hn::NegMulAdd(p.z, q.y, hn::Mul(p.y, q.z)), hn::NegMulAdd(p.x, q.z, hn::Mul(p.z, q.x)),
          hn::NegMulAdd(p.y, q.x, hn::Mul(p.x, q.y))};
}
template <class D>
HWY_INLINE Vector3<D> largest(const Vector3<D>& p, const Vector3<D>& q) {
  return {hn::Max(p.x, q.x), hn::Max(p.y, q.y), hn::Max(p.z, q.z)};
}

template <class Real>
Vec3 departure(const RowLayout<Real>& layout, std::uint32_t number, double drift, const Vec3& spin,
               const RowState<Real>& state) {
  using D = Lanes<Real>;
  const D d;
  const RowBlock& block = layout.blocks[number];
  const Starts<Real> all_x = starts_of<Real>(state.x, block.first);
  const Starts<Real> all_v = starts_of<Real>(state.v, block.first);
  const auto set = [&](double value) { return hn::Set(d, static_cast<Real>(value)); };
  const Vector3<D> omega{set(spin.x()), set(spin.y()), set(spin.z())};
  const auto size = [&](std::uint32_t p) -> Vector3<D> {
    const Vector3<D> apart = load(d, all_v, p) - cross<D>(omega, load(d, all_x, p));
    return {hn::Abs(apart.x), hn::Abs(apart.y), hn::Abs(apart.z)};
  };
  Vector3<D> most{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  std::uint32_t p = 0;
  for (; p + lane_count<Real>() <= block.own; p += lane_count<Real>())
    most = largest<D>(most, size(p));
  if (p < block.own) {  // the padding does not rotate
    const auto own = hn::FirstN(d, block.own - p);
    const Vector3<D> last = size(p);
    most = largest<D>(most, {hn::IfThenElseZero(own, last.x), hn::IfThenElseZero(own, last.y),
                             hn::IfThenElseZero(own, last.z)});
  }
  const auto result = [&](hn::Vec<D> of) {
    return std::abs(drift) * static_cast<double>(hn::GetLane(hn::MaxOfLanes(d, of)));
  };
  return {result(most.x), result(most.y), result(most.z)};
}

/// Calls take(octant, volume) for the corners of each octant of a star, at the lanes from `lane`.
/// Volumes of corners have the sign of their octant.
template <class Real, class Take>
HWY_INLINE void for_each_octant(const CornerStar& star, std::uint32_t lane,
                                const Starts<Real>& all_x, const Take& take) {
  using D = Lanes<Real>;
  const D d;
  const std::size_t own = star.base + lane;
  const Vector3<D> x = load(d, all_x, own);
  // Unsigned arithmetic: the sum of a place and a negative number of places wraps around.
  const auto edge = [&](std::size_t slot) {
    return load(d, all_x,
                own + static_cast<std::size_t>(static_cast<std::ptrdiff_t>(star.to[slot]))) -
           x;
  };
  const Vector3<D> along_x[2] = {edge(0), edge(1)};
  const Vector3<D> along_y[2] = {edge(2), edge(3)};
  const Vector3<D> along_z[2] = {edge(4), edge(5)};
  for (std::uint32_t yz = 0; yz < 4; ++yz) {
    const Vector3<D> face = cross<D>(along_y[yz / 2], along_z[yz % 2]);
    take(yz, dot<D>(along_x[0], face));
    take(4 + yz, dot<D>(along_x[1], face));
  }
}

/// Corner by corner.
template <class Real>
HWY_NOINLINE void add_star(const RowCorners<Real>& corners, std::size_t number, std::uint32_t lane,
                           const Starts<Real>& all_x, MarginFilter<Real>& filter) {
  const Lanes<Real> d;
  const StarProperties<Real>& terms = corners.properties[corners.stars[number].properties];
  for_each_octant(corners.stars[number], lane, all_x, [&](std::uint32_t octant, auto volume) {
    alignas(64) Real margins[kRowLanes];
    hn::Store(hn::MulAdd(volume, hn::LoadU(d, terms.scale[octant] + lane),
                         hn::LoadU(d, terms.offset[octant] + lane)),
              d, margins);
    for (std::uint32_t i = 0; i < lane_count<Real>(); ++i)
      filter.add(corners.numbers[number][octant][lane + i], margins[i]);
  });
}

template <class Real>
double find_corners(const RowLayout<Real>& layout, std::uint32_t number, double margin,
                    RowState<Real>& state, std::vector<std::uint32_t>& below) {
  using D = Lanes<Real>;
  const D d;
  const RowCorners<Real>& corners = layout.corners;
  double farthest = 0;
  for (const Box3& box : state.bounds) farthest = std::max(farthest, farthest_coordinate(box));
  MarginFilter<Real> filter(margin, margin_rounding<Real>(farthest), below);
  if (corners.stars.empty()) return filter.least();
  const Starts<Real> all_x = starts_of<Real>(state.x);
  const auto limit = hn::Set(d, filter.limit());
  auto least = hn::Set(d, std::numeric_limits<Real>::infinity());
  for (std::size_t s = corners.first_star[number]; s < corners.first_star[number + 1]; ++s) {
    const StarProperties<Real>& terms = corners.properties[corners.stars[s].properties];
    for (std::uint32_t lane = 0; lane < kRowLanes; lane += lane_count<Real>()) {
      auto of_star = hn::Set(d, std::numeric_limits<Real>::infinity());
      auto sum = hn::Zero(d);
      for_each_octant(corners.stars[s], lane, all_x, [&](std::uint32_t octant, auto volume) {
        sum = hn::Add(sum, volume);
        of_star = hn::Min(of_star, hn::MulAdd(volume, hn::LoadU(d, terms.scale[octant] + lane),
                                              hn::LoadU(d, terms.offset[octant] + lane)));
      });
      // A minimum may lose what is not a number, the sum does not.
      if (hn::AllTrue(d, hn::And(hn::Ge(of_star, limit), hn::IsFinite(sum))))
        least = hn::Min(least, of_star);
      else
        add_star(corners, s, lane, all_x, filter);
    }
  }
  filter.add_above(hn::GetLane(hn::MinOfLanes(d, least)));
  return filter.least();
}

// Compares squares of lengths, which needs no square roots.
template <class Real>
double largest_strain(const RowLayout<Real>& layout, std::uint32_t number, RowState<Real>& state) {
  using D = Lanes<Real>;
  const D d;
  const RowBlock& block = layout.blocks[number];
  const Starts<Real> x = starts_of<Real>(state.x, block.first);
  const std::uint32_t* const first_row = layout.first_row.data() + block.first / kRowLanes;
  SquaredStretch<Real> stretch;
  for (std::uint32_t p = 0; p < block.places(); p += lane_count<Real>()) {
    const std::uint32_t lane = p % kRowLanes;
    const Vector3<D> own_x = load(d, x, p);
    for (std::uint32_t r = first_row[p / kRowLanes]; r < first_row[p / kRowLanes + 1]; ++r) {
      const SpringRow& row = layout.rows[r];
      const RowLengths<Real>& lengths = layout.lengths[row.properties];
      const Vector3<D> along = load(d, x, p + row.ahead) - own_x;
      stretch.add(hn::MulAdd(dot<D>(along, along), hn::LoadU(d, lengths.inverse_square + lane),
                             hn::LoadU(d, lengths.missing + lane)));
    }
  }
  return stretch.largest_strain();
}

}  // namespace springlod::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
