#include "lod/merging/rigid_stars.hpp"

#include <algorithm>
#include <utility>

#include "lod/merging/rigidity.hpp"

namespace springlod::lod {
namespace {

// A node is held if lambda_min / lambda_max of sum u u^T over its springs to held nodes is at least
// this: its distance to their plane is then at least some hundredths of their distances.
constexpr double kHeld = 1e-3;
// Sine of the angle at which three nodes count as collinear.
constexpr double kStraight = 0.03;

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 p = b - a;
  const Vec3 q = c - a;
  return !(p.cross(q).norm() > kStraight * p.norm() * q.norm());
}

using Links = std::vector<RigidStars::Link>;

Links::iterator find(Links& links, std::uint32_t node) {
  return std::lower_bound(
      links.begin(), links.end(), node,
      [](const RigidStars::Link& link, std::uint32_t wanted) { return link.node < wanted; });
}

void add(Links& links, std::uint32_t node, double tension) {
  const auto at = find(links, node);
  if (at != links.end() && at->node == node)
    at->tension += tension;
  else
    links.insert(at, {node, tension});
}

bool joined(const Links& links, std::uint32_t node) {
  return std::binary_search(
      links.begin(), links.end(), RigidStars::Link{node, 0},
      [](const RigidStars::Link& l, const RigidStars::Link& r) { return l.node < r.node; });
}

}  // namespace

RigidStars::RigidStars(const MassSpringModel& model)
    : mass_(model.mass),
      center_(model.rest),
      links_(model.node_count()),
      placed_at_(model.node_count(), 0) {
  // Springs are sorted by (a, b), so that each node first gets its lower neighbours, ascending.
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    links_[model.b[s]].push_back({model.a[s], model.stiffness[s] * model.rest_length[s]});
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    links_[model.a[s]].push_back({model.b[s], model.stiffness[s] * model.rest_length[s]});
}

bool RigidStars::grows_from(std::uint32_t i, std::uint32_t j, std::uint32_t k) {
  ++now_;
  for (const std::uint32_t seed : {i, j, k}) placed_at_[seed] = now_;
  std::size_t left = links_[i].size() - 2;
  for (bool grown = true; grown && left > 0;) {
    grown = false;
    for (const Link& link : links_[i]) {
      if (placed(link.node)) continue;
      Rigidity held;
      for (const Link& other : links_[link.node]) {
        if (!placed(other.node)) continue;
        const Vec3 d = center_[other.node] - center_[link.node];
        held.add_spring(d, d.norm());
      }
      if (held.springs() < 3 || !held.at_least(kHeld)) continue;
      placed_at_[link.node] = now_;
      --left;
      grown = true;
    }
  }
  return left == 0;
}

bool RigidStars::rigid(std::uint32_t i) {
  const Links& links = links_[i];
  for (std::size_t p = 0; p < links.size(); ++p)
    for (std::size_t q = p + 1; q < links.size(); ++q) {
      const std::uint32_t j = links[p].node;
      const std::uint32_t k = links[q].node;
      if (!joined(links_[j], k) || collinear(center_[i], center_[j], center_[k])) continue;
      if (grows_from(i, j, k)) return true;
      break;  // mostly the same growth: the next neighbour
    }
  return false;
}

RigidStars::Before RigidStars::fuse(std::uint32_t kept, std::uint32_t gone) {
  Before before{kept, gone, mass_[kept], center_[kept], {}};
  before.links.emplace_back(kept, links_[kept]);
  before.links.emplace_back(gone, links_[gone]);
  for (const Link& link : links_[gone])
    if (link.node != kept) before.links.emplace_back(link.node, links_[link.node]);
  const double mass = mass_[kept] + mass_[gone];
  center_[kept] = (mass_[kept] * center_[kept] + mass_[gone] * center_[gone]) / mass;
  mass_[kept] = mass;
  const Links moved = std::exchange(links_[gone], {});
  links_[kept].erase(find(links_[kept], gone));
  for (const Link& link : moved) {
    if (link.node == kept) continue;
    Links& theirs = links_[link.node];
    theirs.erase(find(theirs, gone));
    add(theirs, kept, link.tension);
    add(links_[kept], link.node, link.tension);
  }
  return before;
}

void RigidStars::undo(Before before) {
  mass_[before.kept] = before.mass;
  center_[before.kept] = before.center;
  for (auto& [node, links] : before.links) links_[node] = std::move(links);
}

}  // namespace springlod::lod
