// Which corners of a block are looked at. Included once for every vector target; see Highway's
// foreach_target.h.
#if defined(SPRINGLOD_CORNER_DUES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPRINGLOD_CORNER_DUES_INL
#undef SPRINGLOD_CORNER_DUES_INL
#else
#define SPRINGLOD_CORNER_DUES_INL
#endif

#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include <hwy/highway.h>

#include "sim/fast/add_product-inl.hpp"
#include "sim/fast/look/corner_look.hpp"
#include "sim/fast/look/corner_margin.hpp"

HWY_BEFORE_NAMESPACE();
namespace springlod::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Calls take(lane) for the lanes of a mask of at most 8.
template <class D, class Take>
HWY_INLINE void for_each_lane(D d, hn::Mask<D> mask, const Take& take) {
  std::uint8_t bits[8];  // StoreMaskBits may write them all
  hn::StoreMaskBits(d, mask, bits);
  for (std::uint32_t rest = bits[0]; rest != 0; rest &= rest - 1)
    take(static_cast<std::uint32_t>(std::countr_zero(rest)));
}

/// The least margin of a group of corners, lane by lane of kMarginLanes. Vectors may have fewer
/// lanes: their number must not decide when a corner is due.
inline constexpr std::uint32_t kMarginLanes = 8;
template <class D>
class LeastMargin {
 public:
  using V = hn::Vec<D>;
  using Real = hn::TFromD<D>;

  /// `farthest`: largest coordinate of a node [m].
  HWY_INLINE explicit LeastMargin(double farthest)
      : rounding_(hn::Set(D(), kMarginRounding<Real> * static_cast<Real>(farthest))) {
    for (std::size_t part = 0; part < kParts; ++part) {
      room_[part] = hn::Set(D(), std::numeric_limits<Real>::max());
      growth_[part] = hn::Set(D(), Real(1));
    }
  }

  /// Adds a corner in each lane from `lane`: its volume, the sum of the squares of its edges, and
  /// its terms. Returns its room, less a bound on the error of rounding [m]: below 0 or not a
  /// number if the corner has no margin.
  HWY_INLINE V add(std::size_t lane, V volume, V squares, V scale, V offset) {
    const std::size_t part = lane / hn::Lanes(D());
    const V growth = hn::Mul(hn::Abs(scale), squares);
    const V room = subtract_product(rounding_, growth, add_product(volume, scale, offset));
    room_[part] = hn::Min(room_[part], room);
    growth_[part] = hn::Max(growth_[part], growth);
    return room;
  }
  /// A lower bound on the margin of all corners, if all have one [m].
  HWY_INLINE double least() const {
    V least = hn::Div(room_[0], growth_[0]);
    for (std::size_t part = 1; part < kParts; ++part)
      least = hn::Min(least, hn::Div(room_[part], growth_[part]));
    return kMarginPart * static_cast<double>(hn::GetLane(hn::MinOfLanes(D(), least)));
  }

 private:
  static constexpr std::size_t kParts = kMarginLanes / hn::MaxLanes(D());
  V rounding_;        // of the room of a corner that has not grown [m]
  V room_[kParts];    // least
  V growth_[kParts];  // largest
};

/// Lists the groups to look at in `dues.now`. Returns the least due travel of the others [m].
HWY_INLINE double list_due(const CornerLook& look, CornerDues& dues) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  dues.now.clear();
  const hn::CappedTag<double, CornerDues::kTogether> d;
  const auto travel = hn::Set(d, look.travel);
  auto least = hn::Set(d, kInfinity);
  for (std::size_t first = 0; first < dues.travel.size(); first += hn::Lanes(d)) {
    const auto of = hn::LoadU(d, dues.travel.data() + first);
    const auto later = hn::Lt(travel, of);
    least = hn::Min(least, hn::IfThenElse(later, of, hn::Set(d, kInfinity)));
    if (HWY_LIKELY(hn::AllTrue(d, later))) continue;
    for_each_lane(d, hn::Not(later), [&](std::uint32_t lane) {
      if (first + lane < dues.count) dues.now.push_back(static_cast<std::uint32_t>(first + lane));
    });
  }
  return hn::GetLane(hn::MinOfLanes(d, least));
}

}  // namespace springlod::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
