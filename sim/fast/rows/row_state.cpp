#include "sim/fast/rows/row_state.hpp"

#include <algorithm>

namespace springlod::sim {
namespace {

template <class Real>
void allocate(std::size_t size, typename RowState<Real>::Coordinates& coordinates) {
  for (auto& array : coordinates) {
    array = hwy::AllocateAligned<Real>(size);
    std::fill_n(array.get(), size, Real(0));
  }
}

}  // namespace

template <class Real>
RowState<Real>::RowState(const RowLayout<Real>& layout, bool with_damping)
    : bounds(layout.blocks.size()), largest_displacement(layout.blocks.size(), Vec3::Zero()) {
  const std::size_t size =
      std::max<std::size_t>(layout.inverse_mass.size() + layout.reach, layout.corners.end);
  allocate<Real>(size, x);
  allocate<Real>(size, v);
  if constexpr (sizeof(Real) == sizeof(float)) allocate<Real>(size, low);
  counts = hwy::AllocateAligned<Real>(size);
  std::fill_n(counts.get(), size, Real(0));
  for (const RowBlock& block : layout.blocks)
    std::fill_n(counts.get() + block.first, block.own, Real(1));
  for (std::size_t b = 0; b < layout.blocks.size(); ++b)
    corner_dues.emplace_back(layout.corners.star_count(b));
  for (const RowBlock& block : layout.blocks) {
    allocate<Real>(block.places() + block.reach, force.emplace_back());
    if (with_damping) allocate<Real>(block.places() + block.reach, damping_force.emplace_back());
  }
}

template struct RowState<float>;
template struct RowState<double>;

}  // namespace springlod::sim
