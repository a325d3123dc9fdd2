#include "lod/guard.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include <Eigen/Eigenvalues>

#include "model/error.hpp"

namespace springlod {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// A simplex (point, rod, triangle, tetrahedron) has at most this many nodes and is rigid when every
// pair is joined, though each node has fewer than 4 springs.
constexpr std::uint32_t kSimplexNodes = 4;

// The merged model as far as the guards need it. Fusing groups keeps k L of every spring, so that
// the graph can be coarsened again and again without looking back at the fine model.
struct Graph {
  struct Edge {
    std::uint32_t a, b;  // a < b
    double tension;      // sum of k L [N]
  };
  std::vector<Vec3> moment;  // mass times centre [kg m]
  std::vector<double> mass;
  std::vector<std::uint8_t> border;
  std::vector<std::uint32_t> part;  // connected part of the fine model
  std::vector<Edge> edges;          // sorted by (a, b)

  std::uint32_t size() const { return static_cast<std::uint32_t>(mass.size()); }
  Vec3 center(std::uint32_t g) const { return moment[g] / mass[g]; }
  double length(const Edge& e) const { return (center(e.b) - center(e.a)).norm(); }
};

void add_up_edges(std::vector<Graph::Edge>& edges) {
  std::stable_sort(edges.begin(), edges.end(), [](const Graph::Edge& x, const Graph::Edge& y) {
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  });
  std::size_t last = 0;
  for (std::size_t e = 1; e < edges.size(); ++e) {
    if (edges[e].a == edges[last].a && edges[e].b == edges[last].b)
      edges[last].tension += edges[e].tension;
    else
      edges[++last] = edges[e];
  }
  if (!edges.empty()) edges.resize(last + 1);
}

Graph fine_graph(const MassSpringModel& fine, const Components& parts) {
  Graph graph;
  graph.mass = fine.mass;
  graph.border = fine.border;
  graph.part = parts.of_node;
  graph.moment.resize(fine.node_count());
  for (std::uint32_t i = 0; i < fine.node_count(); ++i)
    graph.moment[i] = fine.mass[i] * fine.rest[i];
  graph.edges.resize(fine.spring_count());
  for (std::uint32_t s = 0; s < fine.spring_count(); ++s)
    graph.edges[s] = {fine.a[s], fine.b[s], fine.stiffness[s] * fine.rest_length[s]};
  return graph;
}

Graph coarsened(const Graph& fine, const Groups& groups) {
  Graph coarse;
  coarse.mass.assign(groups.count, 0);
  coarse.moment.assign(groups.count, Vec3::Zero());
  coarse.border.assign(groups.count, 0);
  coarse.part.assign(groups.count, 0);
  for (std::uint32_t i = 0; i < fine.size(); ++i) {
    const std::uint32_t g = groups.of[i];
    coarse.mass[g] += fine.mass[i];
    coarse.moment[g] += fine.moment[i];
    coarse.border[g] |= fine.border[i];
    coarse.part[g] = fine.part[i];
  }
  coarse.edges.reserve(fine.edges.size());
  for (const Graph::Edge& e : fine.edges) {
    const auto [low, high] = std::minmax(groups.of[e.a], groups.of[e.b]);
    if (low != high) coarse.edges.push_back({low, high, e.tension});
  }
  add_up_edges(coarse.edges);
  return coarse;
}

// Nodes joined into clusters, numbered by their lowest member.
class Clusters {
 public:
  explicit Clusters(std::uint32_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  bool unite(std::uint32_t x, std::uint32_t y) {
    x = root(x);
    y = root(y);
    if (x == y) return false;
    parent_[std::max(x, y)] = std::min(x, y);
    return true;
  }
  Groups groups() {
    Groups result{std::vector<std::uint32_t>(parent_.size()), 0};
    for (std::uint32_t i = 0; i < parent_.size(); ++i) {
      const std::uint32_t r = root(i);
      result.of[i] = r == i ? result.count++ : result.of[r];
    }
    return result;
  }

 private:
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  std::vector<std::uint32_t> parent_;
};

class Guard {
 public:
  Guard(const MassSpringModel& fine, const Groups& groups, const GuardOptions& options)
      : options_(options) {
    const Components parts = connected_components(fine);
    const Graph base = fine_graph(fine, parts);
    // A rope or a cloth is floppy by its nature; only parts that were solid are kept solid.
    solid_part_.assign(parts.count, false);
    const std::vector<bool> floppy = floppy_nodes(base, std::vector<bool>(parts.count, true));
    for (std::uint32_t i = 0; i < base.size(); ++i)
      if (!floppy[i]) solid_part_[base.part[i]] = true;
    for (const double length : fine.rest_length) mean_length_ += length;
    mean_length_ /= std::max(1U, fine.spring_count());
    result_.groups = groups;
    graph_ = coarsened(base, groups);
  }

  GuardedGroups run() {
    while (fuse_coincident() || fuse_floppy()) {
    }
    return result_;
  }

 private:
  bool may_fuse(std::uint32_t g) const {
    return options_.border != BorderRule::strong || graph_.border[g] == 0;
  }

  bool apply(Clusters& clusters, std::uint32_t fused) {
    if (fused == 0) return false;
    const Groups groups = clusters.groups();
    graph_ = coarsened(graph_, groups);
    result_.groups = compose(result_.groups, groups);
    return true;
  }

  bool fuse_coincident() {
    Clusters clusters(graph_.size());
    std::vector<bool> taken(graph_.size(), false);
    std::uint32_t fused = 0;
    for (const Graph::Edge& e : graph_.edges) {
      // One fusion a node and pass: a fused pair has a new centre, which decides anew.
      if (taken[e.a] || taken[e.b] || !may_fuse(e.a) || !may_fuse(e.b)) continue;
      if (!(graph_.length(e) < options_.coincident_fraction * mean_length_)) continue;
      taken[e.a] = taken[e.b] = true;
      fused += clusters.unite(e.a, e.b) ? 1 : 0;
    }
    result_.fused_coincident += fused;
    return apply(clusters, fused);
  }

  bool fuse_floppy() {
    const std::vector<bool> floppy = floppy_nodes(graph_, solid_part_);
    const std::vector<std::uint32_t> partner = partners(floppy);
    Clusters clusters(graph_.size());
    std::vector<bool> taken(graph_.size(), false);
    std::uint32_t fused = 0;
    for (std::uint32_t g = 0; g < graph_.size(); ++g) {
      const std::uint32_t p = partner[g];
      if (p == kNone || taken[g] || taken[p]) continue;
      taken[g] = taken[p] = true;
      fused += clusters.unite(g, p) ? 1 : 0;
    }
    result_.fused_floppy += fused;
    return apply(clusters, fused);
  }

  // Nearest neighbour each floppy node may fuse with. Under a weak border one of its own kind is
  // taken before a nearer one of the other kind, so that the surface stays where it is.
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
          options_.border == BorderRule::weak && graph_.border[g] != graph_.border[other];
      Best& b = best[g];
      const bool better = other_kind != b.other_kind ? b.other_kind : length < b.length;
      if (b.node == kNone || better) b = {other, other_kind, length};
    };
    for (const Graph::Edge& e : graph_.edges) {
      if (!floppy[e.a] && !floppy[e.b]) continue;
      const double length = graph_.length(e);
      offer(e.a, e.b, length);
      offer(e.b, e.a, length);
    }
    std::vector<std::uint32_t> partner(graph_.size());
    for (std::uint32_t g = 0; g < graph_.size(); ++g) partner[g] = best[g].node;
    return partner;
  }

  std::vector<bool> floppy_nodes(const Graph& graph, const std::vector<bool>& solid_part) const {
    std::vector<std::uint32_t> part_size(solid_part.size(), 0);
    for (const std::uint32_t p : graph.part) ++part_size[p];
    std::vector<std::uint32_t> springs(graph.size(), 0);
    std::vector<Mat3> rigidity(graph.size(), Mat3::Zero());
    for (const Graph::Edge& e : graph.edges) {
      ++springs[e.a];
      ++springs[e.b];
      const Vec3 d = graph.center(e.b) - graph.center(e.a);
      const double length = d.norm();
      if (!(length > 0)) continue;
      const Mat3 k_uu = e.tension / (length * length * length) * d * d.transpose();
      rigidity[e.a] += k_uu;
      rigidity[e.b] += k_uu;
    }
    std::vector<bool> floppy(graph.size(), false);
    for (std::uint32_t g = 0; g < graph.size(); ++g) {
      if (!solid_part[graph.part[g]]) continue;
      const std::uint32_t nodes = part_size[graph.part[g]];
      if (nodes <= kSimplexNodes)
        floppy[g] = springs[g] + 1 < nodes;
      else
        floppy[g] = springs[g] < options_.least_springs || nearly_flat(rigidity[g]);
    }
    return floppy;
  }

  bool nearly_flat(const Mat3& rigidity) const {
    Eigen::SelfAdjointEigenSolver<Mat3> solver;
    solver.computeDirect(rigidity, Eigen::EigenvaluesOnly);
    return !(solver.eigenvalues()[0] >= options_.least_rigidity * solver.eigenvalues()[2]);
  }

  GuardOptions options_;
  Graph graph_;
  double mean_length_ = 0;  // of the fine model [m]
  std::vector<bool> solid_part_;
  GuardedGroups result_;
};

}  // namespace

GuardedGroups guard_groups(const MassSpringModel& fine, const Groups& groups,
                           const GuardOptions& options) {
  validate(groups);
  return Guard(fine, groups, options).run();
}

}  // namespace springlod
