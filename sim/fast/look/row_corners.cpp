#include "sim/fast/look/row_corners.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "sim/fast/look/corner_margin.hpp"
#include "sim/fast/palette.hpp"

namespace springlod::sim {
namespace {

/// A neighbour in a star.
struct Arm {
  std::uint32_t slot = 0;  // index into CornerStar::to
  std::int32_t to = 0;     // [places]
};

/// A corner in a star.
struct Spread {
  std::array<Arm, 3> arms;
  std::uint32_t octant = 0;
  double sign = 1;  // of the determinant of the edges along x, y and z
};

/// Index into CornerStar::to of the side to which an edge mainly points.
std::uint32_t slot_of(const Vec3& edge) {
  Eigen::Index axis = 0;
  edge.cwiseAbs().maxCoeff(&axis);
  return 2 * static_cast<std::uint32_t>(axis) + (edge[axis] > 0 ? 1 : 0);
}

/// `to`: places from the corner's node to its neighbours.
Spread spread(const Corner& corner, const std::vector<Vec3>& rest,
              const std::array<std::int32_t, 3>& to) {
  Spread result;
  std::array<std::uint32_t, 3> axes{};
  for (std::size_t i = 0; i < 3; ++i) {
    result.arms[i] = {slot_of(rest[corner.node[i + 1]] - rest[corner.node[0]]), to[i]};
    axes[i] = result.arms[i].slot / 2;
  }
  const bool has_all_axes = (1U << axes[0] | 1U << axes[1] | 1U << axes[2]) == 7;
  // Otherwise the neighbours take the upper sides, in their order, in a star of their own.
  if (!has_all_axes)
    for (std::uint32_t i = 0; i < 3; ++i) result.arms[i].slot = 2 * i + 1;
  else if ((axes[1] + 3 - axes[0]) % 3 == 2)
    result.sign = -1;
  for (const Arm& arm : result.arms)
    if (arm.slot % 2 == 1) result.octant |= 4U >> arm.slot / 2;
  return result;
}

/// Builds the stars, place by place.
template <class Real>
class Starring {
 public:
  Starring(const MassSpringModel& model, const RowLayout<Real>& layout)
      : model_(model), layout_(layout) {}

  RowCorners<Real> stars() {
    const std::vector<std::uint32_t> first = first_corners(model_);
    for (const RowBlock& block : layout_.blocks) {
      begin_ = open_ = corners_.stars.size();
      corners_.first_star.push_back(static_cast<std::uint32_t>(begin_));
      for (std::uint32_t p = block.first; p < block.first + block.own; ++p) {
        const std::uint32_t node = layout_.node[p];
        for (std::uint32_t c = first[node]; c < first[node + 1]; ++c) add(p, c);
      }
      close_block();
    }
    corners_.first_star.push_back(static_cast<std::uint32_t>(corners_.stars.size()));
    return std::move(corners_);
  }

 private:
  std::uint32_t place(std::uint32_t node) const {
    const Place at = layout_.place[node];
    return layout_.blocks[at.block].first + at.index;
  }

  void add(std::uint32_t at, std::uint32_t number) {
    const Corner& corner = model_.corners[number];
    std::array<std::int32_t, 3> to{};
    for (std::size_t i = 0; i < 3; ++i)
      to[i] = static_cast<std::int32_t>(place(corner.node[i + 1])) - static_cast<std::int32_t>(at);
    const Spread as = spread(corner, model_.rest, to);
    CornerStar& star = star_for(at, as);
    for (const Arm& arm : as.arms) star.to[arm.slot] = arm.to;
    const auto index = static_cast<std::size_t>(&star - corners_.stars.data());
    const std::uint32_t lane = at - star.base;
    const MarginTerms terms = margin_terms(corner, model_.rest);
    corners_.numbers[index][as.octant][lane] = number;
    StarProperties<Real>& properties = properties_[index - begin_];
    properties.scale[as.octant][lane] = static_cast<Real>(as.sign * terms.scale);
    properties.offset[as.octant][lane] = static_cast<Real>(terms.offset);
  }

  /// The star of the block that has room for the corner, or a new one.
  CornerStar& star_for(std::uint32_t at, const Spread& as) {
    while (open_ < corners_.stars.size() && corners_.stars[open_].base + kRowLanes <= at) ++open_;
    for (std::size_t s = open_; s < corners_.stars.size(); ++s)
      if (fits(s, at, as)) return corners_.stars[s];
    StarProperties<Real> none{};
    for (auto& lanes : none.offset) std::fill(std::begin(lanes), std::end(lanes), kMissing);
    properties_.push_back(none);
    for (auto& lanes : corners_.numbers.emplace_back()) lanes.fill(kNoCorner);
    // Aligned with the rows, unless a neighbour would lie before the first place.
    CornerStar& star = corners_.stars.emplace_back();
    star.base = at / kRowLanes * kRowLanes;
    if (!reaches(star, as)) star.base = at;
    return star;
  }
  bool fits(std::size_t index, std::uint32_t at, const Spread& as) const {
    const CornerStar& star = corners_.stars[index];
    if (at >= star.base + kRowLanes || !reaches(star, as)) return false;
    for (const Arm& arm : as.arms)
      if (star.to[arm.slot] != 0 && star.to[arm.slot] != arm.to) return false;
    return corners_.numbers[index][as.octant][at - star.base] == kNoCorner;
  }
  static bool reaches(const CornerStar& star, const Spread& as) {
    return std::all_of(as.arms.begin(), as.arms.end(), [&](const Arm& arm) {
      return static_cast<std::int32_t>(star.base) + arm.to >= 0;
    });
  }

  void close_block() {
    for (std::size_t s = begin_; s < corners_.stars.size(); ++s) {
      CornerStar& star = corners_.stars[s];
      star.properties = palette_.number(properties_[s - begin_]);
      const std::int32_t farthest = *std::max_element(star.to.begin(), star.to.end());
      corners_.end = std::max(
          corners_.end, star.base + kRowLanes + static_cast<std::uint32_t>(std::max(farthest, 0)));
    }
    properties_.clear();
  }

  static constexpr auto kMissing = static_cast<Real>(MarginTerms{}.offset);

  const MassSpringModel& model_;
  const RowLayout<Real>& layout_;
  RowCorners<Real> corners_;
  Palette<StarProperties<Real>> palette_{corners_.properties};
  // Of the block:
  std::size_t begin_ = 0;                         // its first star
  std::size_t open_ = 0;                          // the first star that may have room
  std::vector<StarProperties<Real>> properties_;  // by star, from its first
};

}  // namespace

template <class Real>
RowCorners<Real> place_corners(const MassSpringModel& model, const RowLayout<Real>& layout) {
  if (model.corners.empty()) return {};
  return Starring<Real>(model, layout).stars();
}

template RowCorners<float> place_corners(const MassSpringModel&, const RowLayout<float>&);
template RowCorners<double> place_corners(const MassSpringModel&, const RowLayout<double>&);

}  // namespace springlod::sim
