#include "sim/fast/look/quad_corners.hpp"

#include <algorithm>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sim/fast/look/corner_margin.hpp"

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

template <class Real>
void add_corner(const MassSpringModel& model, std::uint32_t number, const std::vector<Place>& place,
                Indices<Real>& indices, QuadBlock<Real>& block) {
  const std::size_t lane = block.corner_number.size() % kEight;
  if (lane == 0) block.corners.push_back(missing_corners<Real>());
  CornerEight<Real>& eight = block.corners.back();
  const Corner& corner = model.corners[number];
  for (std::size_t n = 0; n < 4; ++n)
    eight.node[n][lane] = static_cast<std::uint16_t>(indices.index(place[corner.node[n]]));
  const MarginTerms terms = margin_terms(corner, model.rest);
  eight.scale[lane] = static_cast<Real>(terms.scale);
  eight.offset[lane] = static_cast<Real>(terms.offset);
  block.corner_number.push_back(number);
}

/// The corners of the nodes of a block, those with the largest margin at rest first. Eight corners
/// are looked at together when the first of them is due, so those with little margin are kept apart
/// from the others.
std::vector<std::uint32_t> by_margin(const MassSpringModel& model,
                                     const std::vector<std::uint32_t>& first,
                                     const std::vector<std::uint32_t>& nodes) {
  std::vector<std::pair<double, std::uint32_t>> order;
  for (const std::uint32_t node : nodes)
    for (std::uint32_t c = first[node]; c < first[node + 1]; ++c)
      order.emplace_back(-corner_margin(model.corners[c], model.rest, model.rest), c);
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::uint32_t> corners;
  for (const auto& [margin, corner] : order) corners.push_back(corner);
  return corners;
}

}  // namespace

template <class Real>
bool place_corners(const MassSpringModel& model, QuadLayout<Real>& layout) {
  const std::vector<std::uint32_t> first = first_corners(model);
  for (std::uint32_t b = 0; b < layout.blocks.size(); ++b) {
    QuadBlock<Real>& block = layout.blocks[b];
    Indices<Real> indices(b, block);
    for (const std::uint32_t corner : by_margin(model, first, block.node))
      add_corner(model, corner, layout.place, indices, block);
    block.corner_number.resize(block.corners.size() * kEight, kNoCorner);
    if (block.indices() - 1 > std::numeric_limits<std::uint16_t>::max()) return false;
  }
  return true;
}

template bool place_corners(const MassSpringModel&, QuadLayout<float>&);
template bool place_corners(const MassSpringModel&, QuadLayout<double>&);

}  // namespace springlod::sim
