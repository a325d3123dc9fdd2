#include "sim/fast/quad_layout.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "sim/fast/block_order.hpp"

namespace springlod {
namespace {

constexpr std::uint32_t kQuad = 4;

// A gap's other end: so far off that its length is neither 0 nor infinite in single precision. [m]
constexpr double kFarAway = 1e6;

/// A spring as seen from the node that works it out.
struct HalfSpring {
  std::uint32_t other = 0;  // place in the order
  std::uint32_t spring = 0;
};

// A node works out the springs to later nodes, but hands on to them what would leave a quad with a
// gap: gaps can only come where too little is left to hand on.
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

/// Fills the blocks of one model.
template <class Real>
class Laying {
 public:
  explicit Laying(const MassSpringModel& model)
      : model_(model),
        order_(order_in_blocks(model.rest, kBlockNodes)),
        rank_(model.node_count()),
        block_of_(model.node_count()) {
    for (std::uint32_t i = 0; i < model.node_count(); ++i) rank_[order_.point[i]] = i;
    for (std::uint32_t b = 0; b + 1 < order_.first.size(); ++b)
      std::fill(block_of_.begin() + order_.first[b], block_of_.begin() + order_.first[b + 1], b);
  }

  SpringBlocks<Real> lay() {
    const auto springs = assign_springs(model_, rank_);
    SpringBlocks<Real> laid;
    laid.blocks.resize(order_.first.size() - 1);
    std::vector<std::vector<Place>> copies(model_.node_count());  // by rank
    for (std::uint32_t b = 0; b < laid.blocks.size(); ++b)
      lay_block(b, springs, copies, laid.blocks[b]);
    for (std::uint32_t b = 0; b < laid.blocks.size(); ++b) list_copies(b, copies, laid.blocks[b]);
    for (std::uint32_t n = 0; n < model_.node_count(); ++n)
      laid.place.push_back(in_block(rank_[n]));
    return laid;
  }

 private:
  Place in_block(std::uint32_t rank) const {
    const std::uint32_t block = block_of_[rank];
    return {block, rank - order_.first[block]};
  }

  void lay_block(std::uint32_t number, const std::vector<std::vector<HalfSpring>>& springs,
                 std::vector<std::vector<Place>>& copies, SpringBlock<Real>& block) const {
    const std::uint32_t first = order_.first[number];
    block.own = order_.first[number + 1] - first;
    std::map<std::uint32_t, std::uint32_t> halo;  // rank -> place, in rising order of rank
    for (std::uint32_t i = 0; i < block.own; ++i)
      for (const HalfSpring& half : springs[first + i])
        if (block_of_[half.other] != number) halo.emplace(half.other, 0);
    for (auto& [rank, place] : halo) {
      place = block.own + static_cast<std::uint32_t>(block.halo.size());
      block.halo.push_back(in_block(rank));
      copies[rank].push_back({number, place});
    }
    const auto nowhere = static_cast<std::uint32_t>(block.own + block.halo.size());
    block.records.resize(nowhere + 1);
    block.forces.resize(nowhere + 1);
    std::fill(std::begin(block.records[nowhere].x), std::end(block.records[nowhere].x),
              static_cast<Real>(kFarAway));
    const auto place_of = [&](std::uint32_t rank) {
      return block_of_[rank] == number ? rank - first : halo.at(rank);
    };
    for (std::uint32_t i = 0; i < block.own; ++i) {
      fill_record(order_.point[first + i], block.records[i]);
      for (const HalfSpring& half : springs[first + i]) {
        if (block.other_end.size() % kQuad == 0) begin_quad(i, block);
        add_spring(place_of(half.other), half.spring, block);
      }
      while (block.other_end.size() % kQuad != 0) add_gap(nowhere, block);
    }
    if (block.quad_node.size() % 2 == 0) return;
    begin_quad(0, block);
    for (std::uint32_t i = 0; i < kQuad; ++i) add_gap(nowhere, block);
  }

  static void begin_quad(std::uint32_t own, SpringBlock<Real>& block) {
    block.quad_node.push_back(static_cast<std::uint16_t>(own));
  }
  void add_spring(std::uint32_t other, std::uint32_t spring, SpringBlock<Real>& block) const {
    block.other_end.push_back(static_cast<std::uint16_t>(other));
    block.stiffness.push_back(static_cast<Real>(model_.stiffness[spring]));
    block.rest_force.push_back(
        static_cast<Real>(model_.stiffness[spring] * model_.rest_length[spring]));
    block.damping.push_back(static_cast<Real>(model_.damping[spring]));
  }
  static void add_gap(std::uint32_t nowhere, SpringBlock<Real>& block) {
    block.other_end.push_back(static_cast<std::uint16_t>(nowhere));
    block.stiffness.push_back(0);
    block.rest_force.push_back(0);
    block.damping.push_back(0);
  }

  void list_copies(std::uint32_t number, const std::vector<std::vector<Place>>& copies,
                   SpringBlock<Real>& block) const {
    for (std::uint32_t i = 0; i < block.own; ++i) {
      block.copies_first.push_back(static_cast<std::uint32_t>(block.copies.size()));
      const auto& of_node = copies[order_.first[number] + i];
      block.copies.insert(block.copies.end(), of_node.begin(), of_node.end());
    }
    block.copies_first.push_back(static_cast<std::uint32_t>(block.copies.size()));
  }

  void fill_record(std::uint32_t node, NodeRecord<Real>& record) const {
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      record.x[axis] = static_cast<Real>(model_.rest[node][axis]);
    record.inverse_mass = static_cast<Real>(1 / model_.mass[node]);
    record.contact_area = static_cast<Real>(model_.contact_area[node]);
  }

  const MassSpringModel& model_;
  BlockOrder order_;
  std::vector<std::uint32_t> rank_;      // node -> place in the order
  std::vector<std::uint32_t> block_of_;  // by rank
};

}  // namespace

template <class Real>
SpringBlocks<Real> make_spring_blocks(const MassSpringModel& model) {
  validate(model);
  return Laying<Real>(model).lay();
}

template <class Real>
void set_state(SpringBlocks<Real>& blocks, const State& state) {
  for (std::size_t n = 0; n < blocks.place.size(); ++n) {
    NodeRecord<Real>& record = blocks.blocks[blocks.place[n].block].records[blocks.place[n].index];
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      record.x[axis] = static_cast<Real>(state.x[n][axis]);
      record.v[axis] = static_cast<Real>(state.v[n][axis]);
    }
  }
}

template <class Real>
void get_state(const SpringBlocks<Real>& blocks, State& state) {
  state.x.resize(blocks.place.size());
  state.v.resize(blocks.place.size());
  for (std::size_t n = 0; n < blocks.place.size(); ++n) {
    const NodeRecord<Real>& record =
        blocks.blocks[blocks.place[n].block].records[blocks.place[n].index];
    state.x[n] = {record.x[0], record.x[1], record.x[2]};
    state.v[n] = {record.v[0], record.v[1], record.v[2]};
  }
}

template SpringBlocks<float> make_spring_blocks(const MassSpringModel&);
template SpringBlocks<double> make_spring_blocks(const MassSpringModel&);
template void set_state(SpringBlocks<float>&, const State&);
template void set_state(SpringBlocks<double>&, const State&);
template void get_state(const SpringBlocks<float>&, State&);
template void get_state(const SpringBlocks<double>&, State&);

}  // namespace springlod
