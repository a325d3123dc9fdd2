// What is read off a block of quads between steps. Included once for every vector target; see
// Highway's foreach_target.h.
#if defined(SPRINGLOD_QUAD_LOOK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPRINGLOD_QUAD_LOOK_INL
#undef SPRINGLOD_QUAD_LOOK_INL
#else
#define SPRINGLOD_QUAD_LOOK_INL
#endif

#include <algorithm>
#include <cmath>
#include <limits>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "sim/correction/corner_watch.hpp"
#include "sim/fast/add_product-inl.hpp"
#include "sim/fast/look/corner_dues-inl.hpp"
#include "sim/fast/look/corner_margin.hpp"
#include "sim/fast/look/stretch-inl.hpp"
#include "sim/fast/quads/quad_copies-inl.hpp"
#include "sim/fast/quads/quad_forces-inl.hpp"
#include "sim/fast/quads/quad_vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace springlod::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A vector padded as the records are.
template <class Real>
NodeVector<Real> padded(const Vec3& v) {
  return {{static_cast<Real>(v.x()), static_cast<Real>(v.y()), static_cast<Real>(v.z())}};
}

/// The matrix of the map x -> v x x, by columns.
template <class Real>
std::array<NodeVector<Real>, 3> cross_matrix(const Vec3& v) {
  return {padded<Real>(v.cross(Vec3(Vec3::UnitX()))), padded<Real>(v.cross(Vec3(Vec3::UnitY()))),
          padded<Real>(v.cross(Vec3(Vec3::UnitZ())))};
}

template <class Real>
Vec3 departure(const QuadLayout<Real>& layout, std::uint32_t number, double drift,
               const RigidMotion& motion, const QuadState<Real>& state) {
  const hn::CappedTag<Real, 4> d;
  const NodeRecord<Real>* records = state[number].records.data();
  const std::array<NodeVector<Real>, 3> turn = cross_matrix<Real>(motion.spin);
  const Real* const counts = state[number].counts.data();
  const NodeVector<Real> velocity = padded<Real>(motion.velocity);
  NodeVector<Real> most;
  for (std::size_t lane = 0; lane < 4; lane += hn::Lanes(d)) {
    const auto common = hn::Load(d, velocity.at + lane);
    const auto by_x = hn::Load(d, turn[0].at + lane);
    const auto by_y = hn::Load(d, turn[1].at + lane);
    const auto by_z = hn::Load(d, turn[2].at + lane);
    auto of_lanes = hn::Zero(d);
    for (std::uint32_t i = 0; i < layout.blocks[number].own; ++i) {
      const NodeRecord<Real>& node = records[i];
      auto apart = hn::Sub(hn::Load(d, node.v + lane), common);
      apart = subtract_product(by_x, hn::Set(d, node.x[0]), apart);
      apart = subtract_product(by_y, hn::Set(d, node.x[1]), apart);
      apart = subtract_product(by_z, hn::Set(d, node.x[2]), apart);
      of_lanes = hn::Max(of_lanes, hn::Abs(hn::Mul(apart, hn::Set(d, counts[i]))));
    }
    hn::Store(of_lanes, d, most.at + lane);
  }
  return std::abs(drift) * Vec3(static_cast<double>(most.at[0]), static_cast<double>(most.at[1]),
                                static_cast<double>(most.at[2]));
}

/// The corners of one call of take() in measure_corners().
template <class Real>
using CornerLanes = hn::CappedTag<Real, kTogether<Real>>;

// measure_corners() calls take(lane, volumes, squares) for the corners from each lane of an eight:
// their volumes [m3] and the sums of the squares of their edges [m2]. measure_squares() finds the
// squares of the lengths of springs [m2].
#if HWY_MAX_BYTES >= 32

template <class Real, class Take>
HWY_INLINE void measure_corners(const CornerEight<Real>& eight, const NodeRecord<Real>* records,
                                const Take& take) {
  for (std::size_t first = 0; first < 2 * kQuad; first += kTogether<Real>) {
    const auto load = [&](std::size_t n) {
      return positions(Real(), [&](std::size_t i) -> const NodeRecord<Real>& {
        return records[eight.node[n][first + i]];
      });
    };
    const auto own = load(0);
    const auto p = transpose(load(1) - own);
    const auto q = transpose(load(2) - own);
    const auto r = transpose(load(3) - own);
    const decltype(p) face{subtract_product(q.z, r.y, hn::Mul(q.y, r.z)),
                           subtract_product(q.x, r.z, hn::Mul(q.z, r.x)),
                           subtract_product(q.y, r.x, hn::Mul(q.x, r.y))};
    take(first, dot(p, face), hn::Add(dot(p, p), hn::Add(dot(q, q), dot(r, r))));
  }
}

template <class Real>
HWY_INLINE void measure_squares(const QuadPair<Real>& pair, const NodeRecord<Real>* records,
                                Real* squares) {
  for (std::size_t first = 0; first < 2 * kQuad; first += kTogether<Real>) {
    const auto own = positions(Real(), [&](std::size_t i) -> const NodeRecord<Real>& {
      return record_at(records, pair.own[(first + i) / kQuad]);
    });
    const auto other = positions(Real(), [&](std::size_t i) -> const NodeRecord<Real>& {
      return record_at(records, pair.other[first + i]);
    });
    const auto along = transpose(other - own);
    hn::Store(dot(along, along), hn::CappedTag<Real, kTogether<Real>>(), squares + first);
  }
}

#else

template <class Real, class Take>
void measure_corners(const CornerEight<Real>& eight, const NodeRecord<Real>* records,
                     const Take& take) {
  Real volumes[2 * kQuad];
  Real squares[2 * kQuad];
  for (std::size_t c = 0; c < 2 * kQuad; ++c) {
    Real e[3][3];
    for (std::size_t n = 0; n < 3; ++n)
      for (std::size_t i = 0; i < 3; ++i)
        e[n][i] = records[eight.node[n + 1][c]].x[i] - records[eight.node[0][c]].x[i];
    const Real face[3] = {e[1][1] * e[2][2] - e[1][2] * e[2][1],
                          e[1][2] * e[2][0] - e[1][0] * e[2][2],
                          e[1][0] * e[2][1] - e[1][1] * e[2][0]};
    volumes[c] = dot(e[0], face);
    squares[c] = dot(e[0], e[0]) + (dot(e[1], e[1]) + dot(e[2], e[2]));
  }
  const CornerLanes<Real> d;
  for (std::size_t lane = 0; lane < 2 * kQuad; lane += hn::Lanes(d))
    take(lane, hn::LoadU(d, volumes + lane), hn::LoadU(d, squares + lane));
}

template <class Real>
void measure_squares(const QuadPair<Real>& pair, const NodeRecord<Real>* records, Real* squares) {
  for (std::size_t s = 0; s < 2 * kQuad; ++s) {
    const NodeRecord<Real>& p = record_at(records, pair.own[s / kQuad]);
    const NodeRecord<Real>& q = record_at(records, pair.other[s]);
    const Real along[3] = {q.x[0] - p.x[0], q.x[1] - p.x[1], q.x[2] - p.x[2]};
    squares[s] = dot(along, along);
  }
}

#endif

// Prefetch distance: as long as an access to main memory takes. [eights of corners]
constexpr std::size_t kEightsAhead = 16;

template <class T>
HWY_INLINE void prefetch(const T* of) {
  for (std::size_t byte = 0; byte < sizeof(T); byte += kCacheLine)
    hwy::Prefetch(reinterpret_cast<const char*>(of) + byte);
}

/// Looks at eight corners. Returns their due travel.
template <class Real>
HWY_INLINE double look_at_eight(const QuadBlock<Real>& block, std::size_t number,
                                const NodeRecord<Real>* records, const CornerLook& look,
                                std::vector<std::uint32_t>& found) {
  const CornerEight<Real>& eight = block.corners[number];
  static_assert(2 * kQuad == kMarginLanes);
  const CornerLanes<Real> d;
  LeastMargin<CornerLanes<Real>> margin(look.farthest);
  bool any = false;
  measure_corners(eight, records, [&](std::size_t lane, auto volumes, auto squares) {
    const auto room = margin.add(lane, volumes, squares, hn::LoadU(d, eight.scale + lane),
                                 hn::LoadU(d, eight.offset + lane));
    const auto has_room = hn::Ge(room, hn::Zero(d));
    if (HWY_LIKELY(hn::AllTrue(d, has_room))) return;
    any = true;
    for_each_lane(d, hn::Not(has_room), [&](std::uint32_t i) {
      const std::uint32_t corner = block.corner_number[2 * kQuad * number + lane + i];
      if (corner != kNoCorner) found.push_back(corner);
    });
  });
  return any ? kDueAtOnce : due_travel(look.travel, margin.least());
}

/// Copies the nodes of other blocks that the given eights of corners need.
template <class Real>
void copy_corner_nodes(const QuadBlock<Real>& block, const std::vector<std::uint32_t>& eights,
                       const QuadState<Real>& state, QuadBlockState<Real>& own) {
  const auto copy = [&](std::uint32_t index) {
    const Place from = index < block.nowhere() ? block.halo[index - block.own]
                                               : block.corner_halo[index - block.nowhere() - 1];
    own.records[index] = state[from.block].records[from.index];
  };
  for (const std::uint32_t e : eights)
    for (const auto& nodes : block.corners[e].node)
      for (const std::uint32_t index : nodes)
        if (index >= block.own) copy(index);
}

template <class Real>
double find_corners(const QuadLayout<Real>& layout, std::uint32_t number, const CornerLook& look,
                    QuadState<Real>& state, std::vector<std::uint32_t>& found) {
  const QuadBlock<Real>& block = layout.blocks[number];
  QuadBlockState<Real>& own = state[number];
  double least = list_due(look, own.corner_dues);
  const std::vector<std::uint32_t>& now = own.corner_dues.now;
  if (now.size() * 8 * kQuad < block.halo.size() + block.corner_halo.size()) {
    copy_corner_nodes(block, now, state, own);
  } else {
    copy_records(block.halo, block.own, state, own);
    copy_records(block.corner_halo, block.nowhere() + 1, state, own);
    prefetch_records(block, own);
  }
  for (std::size_t n = 0; n < now.size(); ++n) {
    prefetch(&block.corners[now[std::min(n + kEightsAhead, now.size() - 1)]]);
    double& due = own.corner_dues.travel[now[n]];
    due = look_at_eight(block, now[n], own.records.data(), look, found);
    least = std::min(least, due);
  }
  return least;
}

// Compares squares of lengths, which needs no square roots.
template <class Real>
double largest_strain(const QuadLayout<Real>& layout, std::uint32_t number,
                      QuadState<Real>& state) {
  const QuadBlock<Real>& block = layout.blocks[number];
  QuadBlockState<Real>& own = state[number];
  copy_records(block.halo, block.own, state, own);
  prefetch_records(block, own);
  const hn::CappedTag<Real, 2 * kQuad> d;
  SquaredStretch<Real> stretch;
  for (std::size_t n = 0; n < block.pairs.size(); ++n) {
    const QuadPair<Real>& pair = block.pairs[n];
    prefetch(&pair + std::min(kPairsAhead, block.pairs.size() - 1 - n));
    alignas(64) Real squares[2 * kQuad];
    measure_squares(pair, own.records.data(), squares);
    for (std::size_t lane = 0; lane < 2 * kQuad; lane += hn::Lanes(d)) {
      const auto stiffness = hn::LoadU(d, pair.stiffness + lane);
      const auto inverse = hn::Div(stiffness, hn::LoadU(d, pair.rest_force + lane));  // 1 / L
      const auto square = hn::Mul(hn::Load(d, squares + lane), hn::Mul(inverse, inverse));
      const auto is_spring = hn::Gt(stiffness, hn::Zero(d));
      stretch.add(hn::IfThenElse(is_spring, square, hn::Set(d, Real(1))));
    }
  }
  return stretch.largest_strain();
}

}  // namespace springlod::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
