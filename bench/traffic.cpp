#include "bench/traffic.hpp"

#include <type_traits>

#include "sim/fast/quads/quad_state.hpp"

namespace springlod::bench {
namespace {

template <class T>
double bytes(const std::vector<T>& array) {
  return static_cast<double>(array.size() * sizeof(T));
}

// Single precision stores the low part of positions too.
template <class Real>
constexpr bool kHasLow = std::is_same_v<Real, float>;

}  // namespace

template <class Real>
Traffic step_traffic(const sim::QuadLayout<Real>& layout, double springs) {
  Traffic sum;
  for (const sim::QuadBlock<Real>& block : layout.blocks) {
    sum.read += bytes(block.inverse_mass) + bytes(block.halo) + bytes(block.pairs) +
                bytes(block.damping) + bytes(block.copied);
    const double touched = block.own + static_cast<double>(block.halo.size());
    sum.changed += touched * (sizeof(sim::NodeRecord<Real>) + sizeof(sim::NodeVector<Real>));
    if (kHasLow<Real>) sum.changed += block.own * sizeof(sim::NodeVector<Real>);
  }
  return {sum.read / springs, sum.changed / springs};
}

template <class Real>
Traffic step_traffic(const sim::RowLayout<Real>& layout, double springs) {
  constexpr double kAxes = 3;
  constexpr double kArrays = kHasLow<Real> ? 3 : 2;  // x, v and the low part of x
  Traffic sum;
  sum.read = bytes(layout.first_row) + bytes(layout.rows) + bytes(layout.properties) +
             bytes(layout.inverse_mass);
  for (const sim::RowBlock& block : layout.blocks)
    sum.changed += kAxes * sizeof(Real) * (kArrays * block.places() + block.places() + block.reach);
  return {sum.read / springs, sum.changed / springs};
}

template Traffic step_traffic(const sim::QuadLayout<float>&, double);
template Traffic step_traffic(const sim::QuadLayout<double>&, double);
template Traffic step_traffic(const sim::RowLayout<float>&, double);
template Traffic step_traffic(const sim::RowLayout<double>&, double);

}  // namespace springlod::bench
