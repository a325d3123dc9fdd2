#include "sim/fast/quad_corners.hpp"

#include <algorithm>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sim/fast/corner_margin.hpp"

namespace springlod::sim {
namespace {

constexpr std::size_t kEight = 2 * kQuad;

/// Gives the nodes of a block their indices; adds to the halo of the corners.
template <class Real>
class Indices {
 public:
  Indices(std::uint32_t number, QuadBlock<Real>& block) : number_(number), block_(&block) {
    for (std::uint32_t h = 0; h < block.halo.size(); ++h)
      index_.emplace(key(block.halo[h]), block.own + h);
  }
  std::uint32_t index(Place at) {
    if (at.block == number_) return at.index;
    const auto [found, is_new] = index_.emplace(key(at), block_->indices());
    if (is_new) block_->corner_halo.push_back(at);
    return found->second;
  }

 private:
  static std::uint64_t key(Place at) { return std::uint64_t{at.block} << 32U | at.index; }

  std::uint32_t number_;
  QuadBlock<Real>* block_;
  std::unordered_map<std::uint64_t, std::uint32_t> index_;  // of the copies
};

template <class Real>
CornerEight<Real> missing_corners() {
  CornerEight<Real> eight;
  std::fill(std::begin(eight.offset), std::end(eight.offset),
            static_cast<Real>(MarginTerms{}.offset));
  return eight;
}

}  // namespace

template <class Real>
bool place_corners(const MassSpringModel& model, QuadLayout<Real>& layout) {
  // By block: index of the corner's own node, and the corner. Sorted, so that neighbours in memory
  // are neighbours in space.
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> corners(layout.blocks.size());
  for (std::uint32_t c = 0; c < model.corner_count(); ++c) {
    const Place at = layout.place[model.corners[c].node[0]];
    corners[at.block].emplace_back(at.index, c);
  }
  for (std::uint32_t b = 0; b < layout.blocks.size(); ++b) {
    std::sort(corners[b].begin(), corners[b].end());
    QuadBlock<Real>& block = layout.blocks[b];
    Indices<Real> indices(b, block);
    for (std::size_t i = 0; i < corners[b].size(); ++i) {
      if (i % kEight == 0) block.corners.push_back(missing_corners<Real>());
      CornerEight<Real>& eight = block.corners.back();
      const std::uint32_t number = corners[b][i].second;
      const Corner& corner = model.corners[number];
      for (std::size_t n = 0; n < 4; ++n)
        eight.node[n][i % kEight] =
            static_cast<std::uint16_t>(indices.index(layout.place[corner.node[n]]));
      const MarginTerms terms = margin_terms(corner, model.rest);
      eight.scale[i % kEight] = static_cast<Real>(terms.scale);
      eight.offset[i % kEight] = static_cast<Real>(terms.offset);
      block.corner_number.push_back(number);
    }
    block.corner_number.resize(block.corners.size() * kEight, kNoCorner);
    if (block.indices() - 1 > std::numeric_limits<std::uint16_t>::max()) return false;
  }
  return true;
}

template bool place_corners(const MassSpringModel&, QuadLayout<float>&);
template bool place_corners(const MassSpringModel&, QuadLayout<double>&);

}  // namespace springlod::sim
