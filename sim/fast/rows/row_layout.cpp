#include "sim/fast/rows/row_layout.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

#include "sim/fast/palette.hpp"

namespace springlod::sim {
namespace {

// Least ratio of the places of a block to those that its longest spring reaches ahead [1], so that
// the block has little work for the next one compared with its own.
constexpr std::uint32_t kBlocksReach = 4;

/// A spring between places.
struct PlacedSpring {
  std::uint32_t first = 0;
  std::uint32_t ahead = 0;
  std::uint32_t spring = 0;
};

// Layers normal to the longest side, so that springs reach as few places ahead as possible.
std::vector<std::uint32_t> order_by_layers(const std::vector<Vec3>& rest) {
  std::array<Eigen::Index, 3> axes{0, 1, 2};
  const Vec3 size = bounds(rest).sizes();
  std::stable_sort(axes.begin(), axes.end(),
                   [&](Eigen::Index i, Eigen::Index j) { return size[i] > size[j]; });
  std::vector<std::uint32_t> order(rest.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t p, std::uint32_t q) {
    for (const Eigen::Index axis : axes)
      if (rest[p][axis] != rest[q][axis]) return rest[p][axis] < rest[q][axis];
    return p < q;
  });
  return order;
}

/// The place of each node.
std::vector<std::uint32_t> places_of(const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> place(order.size());
  for (std::uint32_t p = 0; p < order.size(); ++p) place[order[p]] = p;
  return place;
}

/// Sorted by the eight places in which they begin, then by reach.
std::vector<PlacedSpring> place_springs(const MassSpringModel& model,
                                        const std::vector<std::uint32_t>& order) {
  const std::vector<std::uint32_t> place = places_of(order);
  std::vector<PlacedSpring> springs(model.spring_count());
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const auto [first, second] = std::minmax(place[model.a[s]], place[model.b[s]]);
    springs[s] = {first, second - first, s};
  }
  std::sort(springs.begin(), springs.end(), [](const PlacedSpring& p, const PlacedSpring& q) {
    return std::tuple(p.first / kRowLanes, p.ahead, p.first) <
           std::tuple(q.first / kRowLanes, q.ahead, q.first);
  });
  return springs;
}

bool same_row(const PlacedSpring& p, const PlacedSpring& q) {
  return p.first / kRowLanes == q.first / kRowLanes && p.ahead == q.ahead;
}

// The forces of a row are added in memory. Rows of neighbouring directions write to overlapping
// places: executed one right after another, each would wait for the store of the previous one.
// Therefore rows that are neighbours in `rows`, which is sorted by reach, are separated.
std::vector<SpringRow> interleave(const std::vector<SpringRow>& rows) {
  constexpr std::size_t kApart = 3;  // directions along a line of a lattice: back, across, forward
  std::vector<SpringRow> mixed;
  for (std::size_t first = 0; first < kApart; ++first)
    for (std::size_t r = first; r < rows.size(); r += kApart) mixed.push_back(rows[r]);
  return mixed;
}

template <class Real>
void lay_rows(const MassSpringModel& model, const std::vector<PlacedSpring>& springs,
              RowLayout<Real>& layout) {
  Palette palette(layout.properties);
  const auto eights = static_cast<std::uint32_t>(layout.inverse_mass.size()) / kRowLanes;
  auto next = springs.begin();
  for (std::uint32_t eight = 0; eight < eights; ++eight) {
    layout.first_row.push_back(static_cast<std::uint32_t>(layout.rows.size()));
    std::vector<SpringRow> rows;
    while (next != springs.end() && next->first / kRowLanes == eight) {
      RowProperties<Real> row;
      const PlacedSpring& leader = *next;
      for (; next != springs.end() && same_row(*next, leader); ++next) {
        const double k = model.stiffness[next->spring];
        const std::uint32_t lane = next->first % kRowLanes;
        row.stiffness[lane] = static_cast<Real>(k);
        row.rest_force[lane] = static_cast<Real>(k * model.rest_length[next->spring]);
        row.damping[lane] = static_cast<Real>(model.damping[next->spring]);
      }
      rows.push_back({leader.ahead, palette.number(row)});
    }
    const std::vector<SpringRow> mixed = interleave(rows);
    layout.rows.insert(layout.rows.end(), mixed.begin(), mixed.end());
  }
  layout.first_row.push_back(static_cast<std::uint32_t>(layout.rows.size()));
}

/// A dilatation term between places.
struct PlacedTerm {
  std::uint32_t first = 0;
  std::array<std::uint32_t, kCellNodes> ahead = {};
  std::uint32_t shape = 0;
  std::uint32_t term = 0;

  bool same_row(const PlacedTerm& other) const {
    return first / kRowLanes == other.first / kRowLanes && ahead == other.ahead &&
           shape == other.shape;
  }
};

/// Sorted by the eight places in which they begin.
template <class Real>
std::vector<PlacedTerm> place_terms(const MassSpringModel& model,
                                    const std::vector<std::uint32_t>& order,
                                    std::vector<TermShape<Real>>& shapes) {
  const DilatationTerms& terms = model.dilatation;
  const std::vector<std::uint32_t> place = places_of(order);
  Palette palette(shapes);
  std::vector<PlacedTerm> placed;
  for (std::uint32_t t = 0; t < terms.count(); ++t) {
    std::array<std::pair<std::uint32_t, std::size_t>, kCellNodes> nodes;  // place, entry
    for (std::size_t e = 0; e < kCellNodes; ++e) nodes[e] = {place[terms.nodes(t)[e]], e};
    std::sort(nodes.begin(), nodes.end());
    PlacedTerm& to = placed.emplace_back();
    to.first = nodes.front().first;
    to.term = t;
    TermShape<Real> shape;
    for (std::size_t e = 0; e < kCellNodes; ++e) {
      to.ahead[e] = nodes[e].first - to.first;
      for (int axis = 0; axis < 3; ++axis)
        shape.gradient[e][axis] = static_cast<Real>(terms.gradients(t)[nodes[e].second][axis]);
    }
    to.shape = palette.number(shape);
  }
  std::sort(placed.begin(), placed.end(), [](const auto& p, const auto& q) {
    return std::tuple(p.first / kRowLanes, p.ahead, p.shape, p.first) <
           std::tuple(q.first / kRowLanes, q.ahead, q.shape, q.first);
  });
  return placed;
}

template <class Real>
void lay_terms(const MassSpringModel& model, RowLayout<Real>& layout) {
  const DilatationTerms& terms = model.dilatation;
  if (terms.empty()) return;
  RowTerms<Real>& to = layout.dilatation;
  const std::vector<PlacedTerm> placed = place_terms(model, layout.node, to.shapes);
  Palette palette(to.properties);
  auto next = placed.begin();
  const auto eights = static_cast<std::uint32_t>(layout.inverse_mass.size()) / kRowLanes;
  for (std::uint32_t eight = 0; eight < eights; ++eight) {
    to.first_row.push_back(static_cast<std::uint32_t>(to.rows.size()));
    while (next != placed.end() && next->first / kRowLanes == eight) {
      const PlacedTerm& leader = *next;
      TermProperties<Real> row;
      for (; next != placed.end() && next->same_row(leader); ++next) {
        const std::uint32_t lane = next->first % kRowLanes;
        row.modulus[lane] = static_cast<Real>(terms.modulus[next->term]);
        row.damping[lane] =
            static_cast<Real>(terms.modulus[next->term] * terms.damping_time[next->term]);
      }
      to.rows.push_back({leader.ahead, palette.number(row), leader.shape});
    }
  }
  to.first_row.push_back(static_cast<std::uint32_t>(to.rows.size()));
}

template <class Real>
RowLengths<Real> lengths_of(const RowProperties<Real>& properties) {
  RowLengths<Real> lengths;
  for (std::uint32_t lane = 0; lane < kRowLanes; ++lane) {
    const auto k = static_cast<double>(properties.stiffness[lane]);
    if (k > 0) {
      const double inverse = k / static_cast<double>(properties.rest_force[lane]);
      lengths.inverse_square[lane] = static_cast<Real>(inverse * inverse);
    } else {
      lengths.missing[lane] = 1;
    }
  }
  return lengths;
}

std::uint32_t whole_rows(std::uint32_t places) {
  return (places + kRowLanes - 1) / kRowLanes * kRowLanes;
}

/// Places that the rows of eight places reach ahead.
template <class Real>
std::uint32_t farthest_ahead(const RowLayout<Real>& layout, std::uint32_t eight) {
  std::uint32_t farthest = 0;
  for (std::uint32_t r = layout.first_row[eight]; r < layout.first_row[eight + 1]; ++r)
    farthest = std::max(farthest, layout.rows[r].ahead);
  const RowTerms<Real>& terms = layout.dilatation;
  if (terms.first_row.empty()) return farthest;
  for (std::uint32_t r = terms.first_row[eight]; r < terms.first_row[eight + 1]; ++r)
    farthest = std::max(farthest, terms.rows[r].ahead.back());
  return farthest;
}

template <class Real>
void cut_blocks(RowLayout<Real>& layout) {
  const auto n = static_cast<std::uint32_t>(layout.node.size());
  std::uint32_t farthest = 0;
  for (std::uint32_t eight = 0; eight + 1 < layout.first_row.size(); ++eight)
    farthest = std::max(farthest, farthest_ahead(layout, eight));
  // An even number of blocks of equal size, so that two threads get equal work.
  const std::uint32_t count = n / std::max(kBlockNodes, kBlocksReach * farthest);
  layout.block_places = whole_rows((n - 1) / std::max(1U, count - count % 2) + 1);
  layout.place.resize(n);
  for (std::uint32_t first = 0; first < n; first += layout.block_places) {
    RowBlock block{first, std::min(layout.block_places, n - first), 0};
    std::uint32_t end = first + block.places();
    for (std::uint32_t p = first; p < first + block.own; p += kRowLanes)
      end = std::max(end, p + kRowLanes + farthest_ahead(layout, p / kRowLanes));
    block.reach = whole_rows(end - (first + block.places()));
    for (std::uint32_t i = 0; i < block.own; ++i)
      layout.place[layout.node[first + i]] = {static_cast<std::uint32_t>(layout.blocks.size()), i};
    layout.reach = std::max(layout.reach, block.reach);
    layout.blocks.push_back(block);
  }
}

}  // namespace

bool has_terms_of_cells(const MassSpringModel& model) {
  const DilatationTerms& terms = model.dilatation;
  for (std::uint32_t t = 0; t < terms.count(); ++t)
    if (terms.nodes(t).size() != kCellNodes) return false;
  return true;
}

template <class Real>
RowLayout<Real> make_row_layout(const MassSpringModel& model) {
  RowLayout<Real> layout;
  layout.node = order_by_layers(model.rest);
  const std::size_t n = layout.node.size();
  layout.inverse_mass.resize((n + kRowLanes - 1) / kRowLanes * kRowLanes);
  for (std::size_t p = 0; p < n; ++p)
    layout.inverse_mass[p] = static_cast<Real>(1 / model.mass[layout.node[p]]);
  lay_rows(model, place_springs(model, layout.node), layout);
  for (const RowProperties<Real>& each : layout.properties)
    layout.lengths.push_back(lengths_of(each));
  lay_terms(model, layout);
  cut_blocks(layout);
  return layout;
}

template RowLayout<float> make_row_layout(const MassSpringModel&);
template RowLayout<double> make_row_layout(const MassSpringModel&);

}  // namespace springlod::sim
