#include "sim/fast/quads/quad_layout.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "sim/fast/block_order.hpp"
#include "sim/fast/look/quad_corners.hpp"

namespace springlod::sim {
namespace {

// Relative difference of damping times that count as equal: c was rounded from (c / k) k. [1]
constexpr double kSameDamping = 1e-12;

/// A spring at the node that computes it.
struct HalfSpring {
  std::uint32_t other = 0;  // rank in the order
  std::uint32_t spring = 0;
};

// A node computes its springs to later nodes. It leaves to those nodes the springs that would form
// an incomplete quad, so quads have gaps only at nodes that cannot pass enough springs on.
std::vector<std::vector<HalfSpring>> assign_springs(const MassSpringModel& model,
                                                    const std::vector<std::uint32_t>& rank) {
  const std::uint32_t n = model.node_count();
  std::vector<std::vector<HalfSpring>> later(n);
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const std::uint32_t p = rank[model.a[s]];
    const std::uint32_t q = rank[model.b[s]];
    later[std::min(p, q)].push_back({std::max(p, q), s});
  }
  std::vector<std::vector<HalfSpring>> kept(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    std::vector<HalfSpring>& open = later[i];
    std::sort(open.begin(), open.end(),
              [](const HalfSpring& p, const HalfSpring& q) { return p.other < q.other; });
    const std::size_t over = (kept[i].size() + open.size()) % kQuad;
    const std::size_t keep = open.size() - (over <= open.size() ? over : 0);
    for (std::size_t j = 0; j < open.size(); ++j) {
      if (j < keep)
        kept[i].push_back(open[j]);
      else
        kept[open[j].other].push_back({i, open[j].spring});
    }
  }
  return kept;
}

/// c / k if all springs have the same, else nothing [s].
std::optional<double> common_damping_time(const MassSpringModel& model) {
  double least = std::numeric_limits<double>::infinity();
  double most = 0;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    least = std::min(least, model.damping[s] / model.stiffness[s]);
    most = std::max(most, model.damping[s] / model.stiffness[s]);
  }
  if (model.spring_count() == 0) return 0;
  return most - least <= kSameDamping * most ? std::optional(most) : std::nullopt;
}

/// Fills the blocks of one model.
template <class Real>
class Laying {
 public:
  Laying(const MassSpringModel& model, std::uint32_t block_nodes)
      : model_(model),
        order_(order_in_blocks(model.rest, block_nodes)),
        rank_(model.node_count()),
        block_of_(model.node_count()),
        damping_time_(common_damping_time(model)),
        terms_of_(order_.first.size() - 1) {
    for (std::uint32_t i = 0; i < model.node_count(); ++i) rank_[order_.point[i]] = i;
    for (std::uint32_t b = 0; b + 1 < order_.first.size(); ++b)
      std::fill(block_of_.begin() + order_.first[b], block_of_.begin() + order_.first[b + 1], b);
    assign_terms();
  }

  /// No value if a block has too many neighbours for its indices.
  std::optional<QuadLayout<Real>> lay() {
    const auto springs = assign_springs(model_, rank_);
    QuadLayout<Real> layout;
    layout.damping_time = damping_time_.value_or(0);
    layout.blocks.resize(order_.first.size() - 1);
    std::vector<std::vector<Place>> copies(model_.node_count());  // by rank
    for (std::uint32_t b = 0; b < layout.blocks.size(); ++b)
      if (!lay_block(b, springs, copies, layout.blocks[b])) return std::nullopt;
    for (std::uint32_t b = 0; b < layout.blocks.size(); ++b) {
      QuadBlock<Real>& block = layout.blocks[b];
      block.first_copy = block.last_copy = b;
      for (std::uint32_t i = 0; i < block.own; ++i)
        for (const Place& copy : copies[order_.first[b] + i]) {
          block.copied.push_back({i, copy});
          block.first_copy = std::min(block.first_copy, copy.block);
          block.last_copy = std::max(block.last_copy, copy.block);
        }
    }
    for (std::uint32_t n = 0; n < model_.node_count(); ++n) layout.place.push_back(place(rank_[n]));
    if (!place_corners(model_, layout)) return std::nullopt;
    return layout;
  }

 private:
  Place place(std::uint32_t rank) const {
    const std::uint32_t block = block_of_[rank];
    return {block, rank - order_.first[block]};
  }

  bool lay_block(std::uint32_t number, const std::vector<std::vector<HalfSpring>>& springs,
                 std::vector<std::vector<Place>>& copies, QuadBlock<Real>& block) const {
    const std::uint32_t first = order_.first[number];
    block.own = order_.first[number + 1] - first;
    std::map<std::uint32_t, std::uint32_t> halo;  // rank -> index, in ascending order of rank
    for (std::uint32_t i = 0; i < block.own; ++i)
      for (const HalfSpring& half : springs[first + i])
        if (block_of_[half.other] != number) halo.emplace(half.other, 0);
    for (const std::uint32_t term : terms_of_[number])
      for (const std::uint32_t node : model_.dilatation.nodes(term))
        if (block_of_[rank_[node]] != number) halo.emplace(rank_[node], 0);
    for (auto& [rank, index] : halo) {
      index = block.nowhere();
      block.halo.push_back(place(rank));
      copies[rank].push_back({number, index});
    }
    if (block.nowhere() * kIndexScale < Real >> std::numeric_limits<std::uint16_t>::max())
      return false;
    const auto index_of = [&](std::uint32_t rank) {
      return block_of_[rank] == number ? rank - first : halo.at(rank);
    };
    std::size_t quads = 0;
    for (std::uint32_t i = 0; i < block.own; ++i) {
      block.node.push_back(order_.point[first + i]);
      block.inverse_mass.push_back(static_cast<Real>(1 / model_.mass[block.node.back()]));
      const std::vector<HalfSpring>& own = springs[first + i];
      for (std::size_t s = 0; s < own.size(); ++s) {
        if (s % kQuad == 0) begin_quad(quads++, i, block);
        add_spring((quads - 1) * kQuad + s % kQuad, index_of(own[s].other), own[s].spring, block);
      }
    }
    for (const std::uint32_t term : terms_of_[number])
      add_term(
          term, [&](std::uint32_t node) { return index_of(rank_[node]); }, block.dilatation);
    return true;
  }

  /// Terms of a block follow its nodes.
  void assign_terms() {
    const auto middle = [&](std::uint32_t term) {
      const auto nodes = model_.dilatation.nodes(term);
      return rank_[nodes[nodes.size() / 2]];
    };
    for (std::uint32_t t = 0; t < model_.dilatation.count(); ++t)
      terms_of_[block_of_[middle(t)]].push_back(t);
    for (std::vector<std::uint32_t>& terms : terms_of_)
      std::stable_sort(terms.begin(), terms.end(),
                       [&](std::uint32_t l, std::uint32_t r) { return middle(l) < middle(r); });
  }

  template <class IndexOf>
  void add_term(std::uint32_t term, const IndexOf& index_of, QuadTerms<Real>& to) const {
    const DilatationTerms& terms = model_.dilatation;
    const auto nodes = terms.nodes(term);
    to.terms.push_back(
        {.modulus = static_cast<Real>(terms.modulus[term]),
         .damping = static_cast<Real>(terms.modulus[term] * terms.damping_time[term]),
         .first = static_cast<std::uint32_t>(to.entries.size()),
         .number = static_cast<std::uint32_t>(nodes.size())});
    for (std::size_t e = 0; e < nodes.size(); ++e) {
      auto& entry = to.entries.emplace_back();
      for (int axis = 0; axis < 3; ++axis)
        entry.gradient[axis] = static_cast<Real>(terms.gradients(term)[e][axis]);
      entry.index = scaled(index_of(nodes[e]));
    }
  }

  /// A pair of quads that consist of gaps, to be filled with springs.
  void begin_quad(std::size_t quad, std::uint32_t own, QuadBlock<Real>& block) const {
    if (quad % 2 == 0) {
      QuadPair<Real>& pair = block.pairs.emplace_back();
      std::fill(std::begin(pair.other), std::end(pair.other), scaled(block.nowhere()));
      if (!damping_time_) block.damping.emplace_back();
    }
    block.pairs.back().own[quad % 2] = scaled(own);
  }
  void add_spring(std::size_t place, std::uint32_t other, std::uint32_t spring,
                  QuadBlock<Real>& block) const {
    const std::size_t lane = place % (2 * kQuad);
    QuadPair<Real>& pair = block.pairs[place / (2 * kQuad)];
    const double k = model_.stiffness[spring];
    pair.other[lane] = scaled(other);
    pair.stiffness[lane] = static_cast<Real>(k);
    pair.rest_force[lane] = static_cast<Real>(k * model_.rest_length[spring]);
    if (!damping_time_) block.damping.back()[lane] = static_cast<Real>(model_.damping[spring]);
  }
  static std::uint16_t scaled(std::uint32_t index) {
    return static_cast<std::uint16_t>(index * kIndexScale<Real>);
  }

  const MassSpringModel& model_;
  BlockOrder order_;
  std::vector<std::uint32_t> rank_;      // node -> rank
  std::vector<std::uint32_t> block_of_;  // by rank
  std::optional<double> damping_time_;
  std::vector<std::vector<std::uint32_t>> terms_of_;  // by block
};

}  // namespace

template <class Real>
QuadLayout<Real> make_quad_layout(const MassSpringModel& model) {
  std::uint32_t block_nodes = kBlockNodes;
  for (;;) {
    auto layout = Laying<Real>(model, block_nodes).lay();
    if (layout) return std::move(*layout);
    if (block_nodes == 1)
      throw InputError(
          "fast layout: a node has more springs than a block has room for; merge it "
          "with a neighbour or run another integrator");
    block_nodes /= 2;
  }
}

template QuadLayout<float> make_quad_layout(const MassSpringModel&);
template QuadLayout<double> make_quad_layout(const MassSpringModel&);

}  // namespace springlod::sim
