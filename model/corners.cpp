#include "model/corners.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"
#include "model/mass_spring.hpp"
#include "model/ranges.hpp"

namespace springlod::inline model {
namespace {

// Relative tolerance of validation for kFlatCorner: a rigid motion or a scaling of the body changes
// the shape of a corner by rounding.
constexpr double kShapeRounding = 1e-9;

struct Edges {
  Vec3 first, second, third;
};

Edges edges_of(const Corner& corner, const std::vector<Vec3>& x) {
  const Vec3& origin = x[corner.node[0]];
  return {x[corner.node[1]] - origin, x[corner.node[2]] - origin, x[corner.node[3]] - origin};
}

double volume_of(const Edges& e) {
  return e.first.dot(e.second.cross(e.third));
}

double product_of_lengths(const Edges& e) {
  return e.first.norm() * e.second.norm() * e.third.norm();
}

double squares_of(const Edges& e) {
  return e.first.squaredNorm() + e.second.squaredNorm() + e.third.squaredNorm();
}

bool by_nodes(const Corner& l, const Corner& r) {
  return l.node < r.node;
}

/// The number of the spring between two nodes.
class SpringLookup {
 public:
  static constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  explicit SpringLookup(const MassSpringModel& model)
      : model_(model), start_(model.node_count() + 1, 0) {
    for (const std::uint32_t a : model.a) ++start_[a + 1];
    for (std::uint32_t i = 0; i < model.node_count(); ++i) start_[i + 1] += start_[i];
  }
  std::uint32_t find(std::uint32_t i, std::uint32_t j) const {
    const std::uint32_t low = std::min(i, j);
    const auto end = model_.b.begin() + start_[low + 1];
    const auto at = std::lower_bound(model_.b.begin() + start_[low], end, std::max(i, j));
    if (at == end || *at != std::max(i, j)) return kNone;
    return static_cast<std::uint32_t>(at - model_.b.begin());
  }

 private:
  const MassSpringModel& model_;
  std::vector<std::uint32_t> start_;
};

void validate_corner(const MassSpringModel& model, const SpringLookup& springs,
                     std::uint32_t number) {
  const Corner& corner = model.corners[number];
  const auto& [n0, n1, n2, n3] = corner.node;
  const auto fail = [&](std::string_view rule) {
    throw InputError(fmt::format("model: corner {} ({} - {}, {}, {}): {}", script_number(number),
                                 script_number(corner.node[0]), script_number(corner.node[1]),
                                 script_number(corner.node[2]), script_number(corner.node[3]),
                                 rule));
  };
  std::array<std::uint32_t, 4> sorted = corner.node;
  std::sort(sorted.begin(), sorted.end());
  if (sorted.back() >= model.node_count()) fail("it refers to a node that does not exist");
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
    fail("its four nodes must differ");
  for (const std::uint32_t neighbour : {n1, n2, n3})
    if (springs.find(n0, neighbour) == SpringLookup::kNone)
      fail("no spring joins its node to one of the other three");
  if (n1 > n2 || n1 > n3) fail("its lowest neighbour must come first");
  if (number > 0 && !(model.corners[number - 1].node < corner.node))
    fail("corners must be sorted by their nodes, none twice");
  if (!range::kYoung.contains(corner.young))
    fail(outside("Young's modulus", corner.young, range::kYoung));
  if (!(corner_volume(corner, model.rest) > 0)) fail("its volume at rest must be above 0");
  if (!(corner_shape(corner, model.rest) >= (1 - kShapeRounding) * kFlatCorner))
    fail("it is too flat at rest");
}

}  // namespace

double corner_volume(const Corner& corner, const std::vector<Vec3>& x) {
  return volume_of(edges_of(corner, x));
}

double corner_shape(const Corner& corner, const std::vector<Vec3>& x) {
  const Edges edges = edges_of(corner, x);
  const double product = product_of_lengths(edges);
  return product > 0 ? volume_of(edges) / product : 0;
}

std::vector<std::uint32_t> inverted_corners(const std::vector<Corner>& corners,
                                            const std::vector<Vec3>& x) {
  std::vector<std::uint32_t> inverted;
  for (std::size_t c = 0; c < corners.size(); ++c)
    if (!(corner_volume(corners[c], x) > 0)) inverted.push_back(static_cast<std::uint32_t>(c));
  return inverted;
}

double corner_squares(const Corner& corner, const std::vector<Vec3>& x) {
  return squares_of(edges_of(corner, x));
}

double corner_margin(const Corner& corner, const std::vector<Vec3>& rest,
                     const std::vector<Vec3>& x) {
  const Edges edges = edges_of(corner, x);
  const double room = volume_of(edges) - kCornerResists * corner_volume(corner, rest);
  return kMarginPart * room / squares_of(edges);
}

bool orient(Corner& corner, const std::vector<Vec3>& rest) {
  std::sort(corner.node.begin() + 1, corner.node.end());
  const Edges edges = edges_of(corner, rest);
  const double volume = volume_of(edges);
  if (volume < 0) std::swap(corner.node[2], corner.node[3]);
  // Squared, which saves the square roots of the lengths.
  return volume != 0 && volume * volume >= kFlatCorner * kFlatCorner * edges.first.squaredNorm() *
                                               edges.second.squaredNorm() *
                                               edges.third.squaredNorm();
}

void settle_corners(std::vector<Corner>& corners, const std::vector<Vec3>& rest) {
  std::erase_if(corners, [&](Corner& corner) { return !orient(corner, rest); });
  if (!std::is_sorted(corners.begin(), corners.end(), by_nodes))
    std::sort(corners.begin(), corners.end(), by_nodes);
}

void validate_corners(const MassSpringModel& model) {
  if (model.corners.empty()) return;
  const SpringLookup springs(model);
  for (std::uint32_t c = 0; c < model.corner_count(); ++c) validate_corner(model, springs, c);
}

}  // namespace springlod::inline model
