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

#include "sim/correction/corner_watch.hpp"
#include "sim/fast/add_product-inl.hpp"
#include "sim/fast/look/corner_dues-inl.hpp"
#include "sim/fast/look/corner_margin.hpp"
#include "sim/fast/look/stretch-inl.hpp"
#include "sim/fast/rows/row_vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace springlod::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class Real>
Vec3 departure(const RowLayout<Real>& layout, std::uint32_t number, double drift,
               const RigidMotion& motion, const RowState<Real>& state) {
  using D = Lanes<Real>;
  const D d;
  const RowBlock& block = layout.blocks[number];
  const Starts<Real> all_x = starts_of<Real>(state.x, block.first);
  const Starts<Real> all_v = starts_of<Real>(state.v, block.first);
  const auto set = [&](double value) { return hn::Set(d, static_cast<Real>(value)); };
  const auto vector = [&](const Vec3& of) -> Vector3<D> {
    return {set(of.x()), set(of.y()), set(of.z())};
  };
  const Vector3<D> velocity = vector(motion.velocity);
  const Vector3<D> spin = vector(motion.spin);
  const Real* const counts = state.counts.get() + block.first;
  Vector3<D> most{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  for (std::uint32_t p = 0; p < block.places(); p += lane_count<Real>()) {
    const Vector3<D> apart = load(d, all_v, p) - velocity - cross<D>(spin, load(d, all_x, p));
    const hn::Vec<D> count = hn::LoadU(d, counts + p);
    const auto larger = [&](hn::Vec<D> than, hn::Vec<D> of) {
      return hn::Max(than, hn::Abs(hn::Mul(count, of)));
    };
    most = {larger(most.x, apart.x), larger(most.y, apart.y), larger(most.z, apart.z)};
  }
  const auto result = [&](hn::Vec<D> of) {
    return std::abs(drift) * static_cast<double>(hn::GetLane(hn::MaxOfLanes(d, of)));
  };
  return {result(most.x), result(most.y), result(most.z)};
}

/// Calls take(octant, volume, squares) for the corners of each octant of a star, at the lanes from
/// `lane`: the volumes, with the sign of their octant, and the sums of the squares of the edges.
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
  const auto square = [](const Vector3<D>& of) { return dot<D>(of, of); };
  const hn::Vec<D> square_x[2] = {square(along_x[0]), square(along_x[1])};
  const hn::Vec<D> square_y[2] = {square(along_y[0]), square(along_y[1])};
  const hn::Vec<D> square_z[2] = {square(along_z[0]), square(along_z[1])};
  for (std::uint32_t yz = 0; yz < 4; ++yz) {
    const Vector3<D> face = cross<D>(along_y[yz / 2], along_z[yz % 2]);
    const hn::Vec<D> squares = hn::Add(square_y[yz / 2], square_z[yz % 2]);
    take(yz, dot<D>(along_x[0], face), hn::Add(square_x[0], squares));
    take(4 + yz, dot<D>(along_x[1], face), hn::Add(square_x[1], squares));
  }
}

/// Looks at the corners of a star. Returns its due travel.
template <class Real>
HWY_INLINE double look_at_star(const RowCorners<Real>& corners, std::size_t number,
                               const Starts<Real>& all_x, const CornerLook& look,
                               std::vector<std::uint32_t>& found) {
  using D = Lanes<Real>;
  const D d;
  const CornerStar& star = corners.stars[number];
  static_assert(kRowLanes == kMarginLanes);
  const StarProperties<Real>& terms = corners.properties[star.properties];
  LeastMargin<D> margin(look.farthest);
  bool any = false;
  for (std::uint32_t lane = 0; lane < kRowLanes; lane += lane_count<Real>()) {
    hn::Vec<D> room[kOctants];
    auto has_room = hn::Eq(hn::Zero(d), hn::Zero(d));
    for_each_octant(star, lane, all_x, [&](std::uint32_t octant, auto volume, auto squares) {
      room[octant] = margin.add(lane, volume, squares, hn::LoadU(d, terms.scale[octant] + lane),
                                hn::LoadU(d, terms.offset[octant] + lane));
      has_room = hn::And(has_room, hn::Ge(room[octant], hn::Zero(d)));
    });
    if (HWY_LIKELY(hn::AllTrue(d, has_room))) continue;
    any = true;
    for (std::uint32_t octant = 0; octant < kOctants; ++octant)
      for_each_lane(d, hn::Not(hn::Ge(room[octant], hn::Zero(d))), [&](std::uint32_t i) {
        const std::uint32_t corner = corners.numbers[number][octant][lane + i];
        if (corner != kNoCorner) found.push_back(corner);
      });
  }
  return any ? kDueAtOnce : due_travel(look.travel, margin.least());
}

template <class Real>
double find_corners(const RowLayout<Real>& layout, std::uint32_t number, const CornerLook& look,
                    RowState<Real>& state, std::vector<std::uint32_t>& found) {
  CornerDues& dues = state.corner_dues[number];
  double least = list_due(look, dues);
  const Starts<Real> all_x = starts_of<Real>(state.x);
  for (const std::uint32_t group : dues.now) {
    const std::size_t star = layout.corners.first_star[number] + group;
    dues.travel[group] = look_at_star(layout.corners, star, all_x, look, found);
    least = std::min(least, dues.travel[group]);
  }
  return least;
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
      stretch.add(add_product(dot<D>(along, along), hn::LoadU(d, lengths.inverse_square + lane),
                              hn::LoadU(d, lengths.missing + lane)));
    }
  }
  return stretch.largest_strain();
}

}  // namespace springlod::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
