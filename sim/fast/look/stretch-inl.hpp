// Included once for every vector target; see Highway's foreach_target.h.
#if defined(SPRINGLOD_STRETCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPRINGLOD_STRETCH_INL
#undef SPRINGLOD_STRETCH_INL
#else
#define SPRINGLOD_STRETCH_INL
#endif

#include <algorithm>
#include <cmath>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace springlod::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The range of (l / L)^2 of springs [1], 1 for a missing spring. The extremes of the squares are
/// those of the strains, so that no spring needs a square root.
template <class Real>
class SquaredStretch {
 public:
  using D = hn::CappedTag<Real, 8>;

  // Not left to the compiler, which would make a constructor for any processor.
  HWY_INLINE SquaredStretch()
      : least_(hn::Set(D(), Real(1))), most_(hn::Set(D(), Real(1))), sum_(hn::Zero(D())) {}
  HWY_INLINE void add(hn::Vec<D> squares) {
    least_ = hn::Min(least_, squares);
    most_ = hn::Max(most_, squares);
    sum_ = hn::Add(sum_, squares);
  }
  /// Largest |l / L - 1| [1]; not a number if a square is not.
  double largest_strain() const {
    const D d;
    // An extreme may lose what is not a number, the sum does not.
    const auto sum = static_cast<double>(hn::GetLane(hn::SumOfLanes(d, sum_)));
    if (std::isnan(sum)) return sum;
    const auto least = static_cast<double>(hn::GetLane(hn::MinOfLanes(d, least_)));
    const auto most = static_cast<double>(hn::GetLane(hn::MaxOfLanes(d, most_)));
    return std::max(std::sqrt(most) - 1, 1 - std::sqrt(least));
  }

 private:
  hn::Vec<D> least_, most_, sum_;
};

}  // namespace springlod::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
