// The order of elimination and its tree, against their definitions.

#include "elastic/solver/dissection.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <catch2/catch.hpp>

#include "elastic/solver/sparse_cholesky.hpp"
#include "elastic/stiffness.hpp"
#include "tests/elastic/elastic_samples.hpp"
#include "tests/support/models.hpp"

using namespace springlod;
using namespace springlod::elastic;
using springlod::test::box_lattice;
using springlod::test::chain_of_nodes;
using springlod::test::random_model;
using springlod::test::side_by_side;

namespace {

Dissection dissected(const MassSpringModel& model) {
  return dissect(model.rest, node_graph(stiffness_matrix(model)));
}

void check_order(const Dissection& found, std::uint32_t nodes) {
  std::vector<std::uint32_t> sorted = found.order;
  std::sort(sorted.begin(), sorted.end());
  REQUIRE(sorted.size() == nodes);
  for (std::uint32_t i = 0; i < nodes; ++i) REQUIRE(sorted[i] == i);
}

/// Pieces follow each other without gaps, none empty, each child before its parent.
void check_pieces(const Dissection& found) {
  std::uint32_t place = 0;
  for (std::uint32_t p = 0; p < found.pieces.size(); ++p) {
    const Dissection::Piece& piece = found.pieces[p];
    CHECK(piece.begin == place);
    CHECK(piece.end > piece.begin);
    CHECK(piece.parent > p);  // kNoParent is larger than any
    place = piece.end;
  }
  CHECK(place == found.order.size());
}

/// Whether `above` is `piece` itself or one of its ancestors.
bool is_above(const Dissection& found, std::uint32_t above, std::uint32_t piece) {
  while (piece < above) piece = found.pieces[piece].parent;
  return piece == above;
}

/// Springs that join two pieces neither of which is above the other: separators that do not
/// separate.
int wrong_couplings(const Dissection& found, const MassSpringModel& model) {
  std::vector<std::uint32_t> piece_of(model.node_count());
  for (std::uint32_t p = 0; p < found.pieces.size(); ++p)
    for (std::uint32_t k = found.pieces[p].begin; k < found.pieces[p].end; ++k)
      piece_of[found.order[k]] = p;
  int wrong = 0;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const auto [low, high] = std::minmax(piece_of[model.a[s]], piece_of[model.b[s]]);
    wrong += is_above(found, high, low) ? 0 : 1;
  }
  return wrong;
}

std::uint32_t size_of(const Dissection::Piece& piece) {
  return piece.end - piece.begin;
}

}  // namespace

TEST_CASE("A dissection orders every node once, children first, and its separators separate") {
  const MassSpringModel model =
      GENERATE(box_lattice(9, 7, 5), box_lattice(40, 2, 2), random_model(3, 6), random_model(1, 8));
  const Dissection found = dissected(model);
  check_order(found, model.node_count());
  check_pieces(found);
  CHECK(found.pieces.size() > 2);
  CHECK(wrong_couplings(found, model) == 0);
  CHECK(found.pieces.back().parent == Dissection::kNoParent);
}

TEST_CASE("Of a lattice one layer of nodes is taken out, across its longest side") {
  const MassSpringModel model = box_lattice(21, 5, 5);
  const Dissection found = dissected(model);
  const Dissection::Piece& top = found.pieces.back();
  CHECK(size_of(top) == 5 * 5);
  const double x = model.rest[found.order[top.begin]].x();
  for (std::uint32_t k = top.begin; k < top.end; ++k) CHECK(model.rest[found.order[k]].x() == x);
  CHECK(x >= 8);
  CHECK(x <= 12);
}

TEST_CASE("The same nodes come in the same order every time") {
  const MassSpringModel model = random_model(7, 7);
  const Dissection one = dissected(model), two = dissected(model);
  CHECK(one.order == two.order);
  REQUIRE(one.pieces.size() == two.pieces.size());
  for (std::size_t p = 0; p < one.pieces.size(); ++p) {
    CHECK(one.pieces[p].begin == two.pieces[p].begin);
    CHECK(one.pieces[p].parent == two.pieces[p].parent);
  }
}

TEST_CASE("Small bodies stay in one piece, no nodes make none") {
  const Dissection few = dissected(chain_of_nodes(10));
  check_order(few, 10);
  REQUIRE(few.pieces.size() == 1);
  CHECK(few.pieces[0].parent == Dissection::kNoParent);
  const Dissection none = dissect({}, {{0}, {}});
  CHECK(none.order.empty());
  CHECK(none.pieces.empty());
}

TEST_CASE("Bodies side by side, loose nodes and nodes in one place are ordered too") {
  const MassSpringModel box = box_lattice(9, 7, 8);
  const MassSpringModel two = side_by_side(box, box, {20, 0, 0});
  const Dissection beside = dissected(two);
  check_order(beside, two.node_count());
  check_pieces(beside);
  CHECK(wrong_couplings(beside, two) == 0);

  const Dissection apart = dissect(box.rest, {std::vector<std::uint32_t>(505, 0), {}});
  check_order(apart, 504);
  check_pieces(apart);
  for (const Dissection::Piece& piece : apart.pieces)  // nothing has to be separated
    CHECK(piece.parent == Dissection::kNoParent);

  const std::vector<Vec3> heap(504, Vec3(1, 2, 3));
  const Dissection together = dissect(heap, node_graph(stiffness_matrix(box)));
  check_order(together, 504);
  CHECK(together.pieces.size() == 1);
}
