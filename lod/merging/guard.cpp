#include "lod/merging/guard.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "lod/merging/relink.hpp"
#include "lod/merging/rigidity.hpp"

namespace springlod::lod {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// A simplex (point, rod, triangle, tetrahedron) has at most this many nodes and is rigid when every
// pair is joined, though each node has fewer than 4 springs.
constexpr std::uint32_t kSimplexNodes = 4;

// View of the fine model for the guards.
struct FineGraph {
  const MassSpringModel& model;
  const Components& components;

  std::uint32_t size() const { return model.node_count(); }
  double mass(std::uint32_t i) const { return model.mass[i]; }
  Vec3 moment(std::uint32_t i) const { return model.mass[i] * model.rest[i]; }
  Vec3 center(std::uint32_t i) const { return moment(i) / mass(i); }
  std::uint8_t border(std::uint32_t i) const { return model.border[i]; }
  std::uint32_t component(std::uint32_t i) const { return components.of_node[i]; }
  double tension(std::uint32_t s) const { return model.stiffness[s] * model.rest_length[s]; }
};

// The merged model as the guards see it. Fusing groups conserves k L of every spring, so the graph
// is coarsened repeatedly without the fine model.
class CoarseGraph {
 public:
  CoarseGraph() = default;
  template <class Fine>
  CoarseGraph(const Fine& fine, const Groups& groups, const Relinking& links) {
    add_up_nodes(fine, groups);
    tension_.assign(links.a.size(), 0);
    for (std::uint32_t s = 0; s < links.into.size(); ++s)
      if (links.into[s] != Relinking::kInside) tension_[links.into[s]] += fine.tension(s);
  }

  std::uint32_t size() const { return static_cast<std::uint32_t>(mass_.size()); }
  double mass(std::uint32_t g) const { return mass_[g]; }
  const Vec3& moment(std::uint32_t g) const { return moment_[g]; }
  const Vec3& center(std::uint32_t g) const { return center_[g]; }
  std::uint8_t border(std::uint32_t g) const { return border_[g]; }
  std::uint32_t component(std::uint32_t g) const { return component_[g]; }
  double tension(std::uint32_t e) const { return tension_[e]; }
  Vec3 offset(std::uint32_t g, std::uint32_t h) const { return center_[h] - center_[g]; }

 private:
  template <class Fine>
  void add_up_nodes(const Fine& fine, const Groups& groups) {
    mass_.assign(groups.count, 0);
    moment_.assign(groups.count, Vec3::Zero());
    border_.assign(groups.count, 0);
    component_.assign(groups.count, 0);
    for (std::uint32_t i = 0; i < fine.size(); ++i) {
      const std::uint32_t g = groups.of[i];
      mass_[g] += fine.mass(i);
      moment_[g] += fine.moment(i);
      border_[g] |= fine.border(i);
      component_[g] = fine.component(i);
    }
    center_.resize(groups.count);
    for (std::uint32_t g = 0; g < groups.count; ++g) center_[g] = moment_[g] / mass_[g];
  }

  std::vector<double> mass_;
  std::vector<Vec3> moment_;  // mass times centre [kg m]
  std::vector<Vec3> center_;
  std::vector<std::uint8_t> border_;
  std::vector<std::uint32_t> component_;  // connected component of the fine model
  std::vector<double> tension_;           // of each edge, sum of k L [N]
};

// Decides whether a node is floppy from its springs and the size of its component.
class FloppyRule {
 public:
  explicit FloppyRule(const GuardOptions& options) : options_(options) {}
  bool floppy(const Rigidity& node, std::uint32_t component_size) const {
    if (component_size <= kSimplexNodes) return node.springs() + 1 < component_size;
    return node.springs() < options_.least_springs || !node.at_least(options_.least_rigidity);
  }

 private:
  GuardOptions options_;
};

template <class Graph>
std::vector<std::uint32_t> component_sizes(const Graph& graph, std::uint32_t components) {
  std::vector<std::uint32_t> size(components, 0);
  for (std::uint32_t i = 0; i < graph.size(); ++i) ++size[graph.component(i)];
  return size;
}

// Whether each component has a sound node. Springs are sorted by their lower end: once those
// that start at a node are added, it has all its springs. Usually the first few nodes decide.
std::vector<bool> sound_components(const FineGraph& fine, const FloppyRule& rule) {
  const std::vector<std::uint32_t> component_size = component_sizes(fine, fine.components.count);
  std::vector<bool> sound(fine.components.count, false);
  std::uint32_t undecided = fine.components.count;
  std::vector<Rigidity> nodes;  // grows to the highest node reached
  std::uint32_t s = 0;
  for (std::uint32_t i = 0; i < fine.size() && undecided > 0; ++i) {
    if (nodes.size() <= i) nodes.resize(i + 1);
    const std::uint32_t component = fine.component(i);
    for (; s < fine.model.spring_count() && fine.model.a[s] == i; ++s) {
      if (sound[component]) continue;
      const std::uint32_t j = fine.model.b[s];
      if (nodes.size() <= j) nodes.resize(j + 1);
      const Vec3 d = fine.center(j) - fine.center(i);
      nodes[i].add_spring(d, fine.tension(s));
      nodes[j].add_spring(d, fine.tension(s));
    }
    if (sound[component] || rule.floppy(nodes[i], component_size[component])) continue;
    sound[component] = true;
    --undecided;
  }
  return sound;
}

class Guard {
 public:
  Guard(const MassSpringModel& fine, const SpringRows& springs, const Groups& groups,
        const GuardOptions& options)
      : options_(options), rule_(options) {
    result_.links = relink(springs, groups);
    result_.groups = groups;
    const Components components = connected_components(fine);
    const FineGraph base{fine, components};
    // A rope or a cloth is floppy from the start; only components that were sound are kept sound.
    sound_component_ = sound_components(base, rule_);
    mean_length_ = mean_spring_length(fine);
    graph_ = CoarseGraph(base, groups, result_.links);
  }

  GuardedGroups run() {
    while (fuse_coincident() || fuse_floppy()) {
    }
    return std::move(result_);
  }

 private:
  struct Edge {
    std::uint32_t a, b;
  };
  std::uint32_t edge_count() const { return static_cast<std::uint32_t>(result_.links.a.size()); }
  Edge edge(std::uint32_t e) const { return {result_.links.a[e], result_.links.b[e]}; }

  bool may_fuse(std::uint32_t g) const {
    return options_.border != BorderRule::strong || graph_.border(g) == 0;
  }

  bool apply(DisjointSets& clusters, std::uint32_t fused) {
    if (fused == 0) return false;
    DisjointSets::Numbers numbers = clusters.numbers();
    const Groups groups{std::move(numbers.of), numbers.count};
    Relinking links = relink(SpringRows(graph_.size(), result_.links.a, result_.links.b), groups);
    graph_ = CoarseGraph(graph_, groups, links);
    result_.groups = compose(result_.groups, groups);
    result_.links = compose(std::move(result_.links), std::move(links));
    return true;
  }

  bool fuse_coincident() {
    const double least = options_.coincident_fraction * mean_length_;
    DisjointSets clusters(graph_.size());
    std::vector<bool> taken(graph_.size(), false);
    std::uint32_t fused = 0;
    for (std::uint32_t e = 0; e < edge_count(); ++e) {
      const auto [a, b] = edge(e);
      if (!(graph_.offset(a, b).norm() < least)) continue;
      // At most one fusion for each node in a pass: a fused pair has a new centroid.
      if (taken[a] || taken[b] || !may_fuse(a) || !may_fuse(b)) continue;
      taken[a] = taken[b] = true;
      fused += clusters.unite(a, b) ? 1 : 0;
    }
    return apply(clusters, fused);
  }

  bool fuse_floppy() {
    const std::vector<bool> floppy = floppy_nodes();
    if (std::find(floppy.begin(), floppy.end(), true) == floppy.end()) return false;
    const std::vector<std::uint32_t> partner = partners(floppy);
    DisjointSets clusters(graph_.size());
    std::vector<bool> taken(graph_.size(), false);
    std::uint32_t fused = 0;
    for (std::uint32_t g = 0; g < graph_.size(); ++g) {
      const std::uint32_t p = partner[g];
      if (p == kNone || taken[g] || taken[p]) continue;
      taken[g] = taken[p] = true;
      fused += clusters.unite(g, p) ? 1 : 0;
    }
    return apply(clusters, fused);
  }

  // The nearest neighbour that each floppy node may fuse with. Under a weak border a neighbour of
  // its own kind (border or inner) goes before a nearer one of the other kind, to preserve the
  // surface.
  std::vector<std::uint32_t> partners(const std::vector<bool>& floppy) const {
    struct Best {
      std::uint32_t node = kNone;
      bool other_kind = true;
      double length = 0;
    };
    std::vector<Best> best(graph_.size());
    const auto offer = [&](std::uint32_t g, std::uint32_t other, double length) {
      if (!floppy[g] || !may_fuse(g) || !may_fuse(other)) return;
      const bool other_kind =
          options_.border == BorderRule::weak && graph_.border(g) != graph_.border(other);
      Best& b = best[g];
      const bool better = other_kind != b.other_kind ? b.other_kind : length < b.length;
      if (b.node == kNone || better) b = {other, other_kind, length};
    };
    for (std::uint32_t e = 0; e < edge_count(); ++e) {
      const auto [a, b] = edge(e);
      if (!floppy[a] && !floppy[b]) continue;
      const double length = graph_.offset(a, b).norm();
      offer(a, b, length);
      offer(b, a, length);
    }
    std::vector<std::uint32_t> partner(graph_.size());
    for (std::uint32_t g = 0; g < graph_.size(); ++g) partner[g] = best[g].node;
    return partner;
  }

  std::vector<bool> floppy_nodes() const {
    std::vector<Rigidity> nodes(graph_.size());
    for (std::uint32_t e = 0; e < edge_count(); ++e) {
      const auto [a, b] = edge(e);
      const Vec3 d = graph_.offset(a, b);
      nodes[a].add_spring(d, graph_.tension(e));
      nodes[b].add_spring(d, graph_.tension(e));
    }
    const std::vector<std::uint32_t> component_size =
        component_sizes(graph_, static_cast<std::uint32_t>(sound_component_.size()));
    std::vector<bool> floppy(graph_.size(), false);
    for (std::uint32_t g = 0; g < graph_.size(); ++g) {
      const std::uint32_t component = graph_.component(g);
      floppy[g] = sound_component_[component] && rule_.floppy(nodes[g], component_size[component]);
    }
    return floppy;
  }

  GuardOptions options_;
  FloppyRule rule_;
  CoarseGraph graph_;
  double mean_length_ = 0;  // of the fine model [m]
  std::vector<bool> sound_component_;
  GuardedGroups result_;
};

}  // namespace

GuardedGroups guard_groups(const MassSpringModel& fine, const SpringRows& springs,
                           const Groups& groups, const GuardOptions& options) {
  return Guard(fine, springs, groups, options).run();
}

GuardedGroups guard_groups(const MassSpringModel& fine, const Groups& groups,
                           const GuardOptions& options) {
  return guard_groups(fine, SpringRows(fine), groups, options);
}

}  // namespace springlod::lod
