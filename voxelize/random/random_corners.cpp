#include "voxelize/random/random_corners.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "model/spring_rows.hpp"
#include "voxelize/lattice/corner_young.hpp"

namespace springlod::voxelize {
namespace {

using Four = std::array<std::uint32_t, 4>;
constexpr unsigned kOctants = 8;

Vec3 diagonal(unsigned octant) {
  return {(octant & 1U) != 0 ? 1.0 : -1.0, (octant & 2U) != 0 ? 1.0 : -1.0,
          (octant & 4U) != 0 ? 1.0 : -1.0};
}

/// The best triple of neighbours for each octant of one node.
class Around {
 public:
  Around(const MassSpringModel& model, const SpringRows& springs)
      : model_(model), springs_(springs) {}

  void add_corners(std::uint32_t node, std::vector<Corner>& corners) {
    gather(node);
    std::array<std::optional<Best>, kOctants> best;
    for (std::size_t i = 0; i < neighbours_.size(); ++i)
      for (std::size_t j = i + 1; j < neighbours_.size(); ++j) {
        if (!joined(i, j)) continue;
        for (std::size_t k = j + 1; k < neighbours_.size(); ++k)
          if (joined(i, k) && joined(j, k)) offer(i, j, k, best);
      }
    for (const std::optional<Best>& triple : best)
      if (triple) {
        Corner corner{{node, neighbours_[triple->i].node, neighbours_[triple->j].node,
                       neighbours_[triple->k].node},
                      0};
        if (orient(corner, model_.rest)) corners.push_back(corner);
      }
  }

 private:
  struct Neighbour {
    std::uint32_t node;
    Vec3 direction;
  };
  struct Best {
    double shape;
    std::size_t i, j, k;
  };

  void gather(std::uint32_t node) {
    neighbours_.clear();
    springs_.for_each(node, [&](std::uint32_t other, std::uint32_t) {
      neighbours_.push_back({other, (model_.rest[other] - model_.rest[node]).normalized()});
    });
    const std::size_t count = neighbours_.size();
    joined_.assign(count * count, false);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = i + 1; j < count; ++j)
        joined_[i * count + j] = springs_.joined(neighbours_[i].node, neighbours_[j].node);
  }

  bool joined(std::size_t i, std::size_t j) const { return joined_[i * neighbours_.size() + j]; }

  void offer(std::size_t i, std::size_t j, std::size_t k,
             std::array<std::optional<Best>, kOctants>& best) const {
    const Vec3& u = neighbours_[i].direction;
    const Vec3& v = neighbours_[j].direction;
    const Vec3& w = neighbours_[k].direction;
    const Vec3 vw = v.cross(w);
    const double volume = u.dot(vw);
    const double shape = std::abs(volume);
    if (shape < kFlatCorner) return;
    const Vec3 wu = w.cross(u);
    const Vec3 uv = u.cross(v);
    for (unsigned o = 0; o < kOctants; ++o) {
      if (best[o] && best[o]->shape >= shape) continue;
      const Vec3 d = diagonal(o) * volume;
      if (d.dot(vw) >= 0 && d.dot(wu) >= 0 && d.dot(uv) >= 0) best[o] = Best{shape, i, j, k};
    }
  }

  const MassSpringModel& model_;
  const SpringRows& springs_;
  std::vector<Neighbour> neighbours_;
  std::vector<bool> joined_;  // of each pair of neighbours
};

Four sorted_nodes(const Corner& corner) {
  Four nodes = corner.node;
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

void keep_once(std::vector<Corner>& corners) {
  const auto by_set = [](const Corner& l, const Corner& r) {
    const Four of_l = sorted_nodes(l), of_r = sorted_nodes(r);
    return of_l != of_r ? of_l < of_r : l.node[0] < r.node[0];
  };
  std::sort(corners.begin(), corners.end(), by_set);
  const auto same = [](const Corner& l, const Corner& r) {
    return sorted_nodes(l) == sorted_nodes(r);
  };
  corners.erase(std::unique(corners.begin(), corners.end(), same), corners.end());
  std::sort(corners.begin(), corners.end(),
            [](const Corner& l, const Corner& r) { return l.node < r.node; });
}

}  // namespace

std::vector<Corner> choose_corners(const MassSpringModel& model) {
  const SpringRows springs(model);
  Around around(model, springs);
  std::vector<Corner> corners;
  for (std::uint32_t node = 0; node < model.node_count(); ++node) around.add_corners(node, corners);
  keep_once(corners);
  for (Corner& corner : corners) corner.young = corner_young(model, corner.node);
  return corners;
}

}  // namespace springlod::voxelize
