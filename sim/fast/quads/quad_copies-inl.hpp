// Copies of other blocks' nodes. Included once for every vector target; see Highway's
// foreach_target.h.
#if defined(SPRINGLOD_QUAD_COPIES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPRINGLOD_QUAD_COPIES_INL
#undef SPRINGLOD_QUAD_COPIES_INL
#else
#define SPRINGLOD_QUAD_COPIES_INL
#endif

#include <algorithm>
#include <vector>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "sim/fast/quads/quad_state.hpp"

HWY_BEFORE_NAMESPACE();
namespace springlod::sim::HWY_NAMESPACE {

constexpr std::size_t kCacheLine = 64;  // [bytes]

/// Copies records from everywhere in the body, in an order that the processor cannot predict, to
/// the indices from `first`.
template <class Real>
void copy_records(const std::vector<Place>& originals, std::uint32_t first,
                  const QuadState<Real>& state, QuadBlockState<Real>& own) {
  const auto origin = [&](std::size_t h) {
    return state[originals[h].block].records.data() + originals[h].index;
  };
  constexpr std::size_t kAhead = 24;  // [nodes]
  for (std::size_t h = 0; h < originals.size(); ++h) {
    hwy::Prefetch(origin(std::min(h + kAhead, originals.size() - 1)));
    own.records[first + h] = *origin(h);
  }
}

template <class Real>
void prefetch_records(const QuadBlock<Real>& block, const QuadBlockState<Real>& own) {
  for (std::size_t i = 0; i < block.own; i += kCacheLine / sizeof(NodeRecord<Real>))
    hwy::Prefetch(&own.records[i]);
}

}  // namespace springlod::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
