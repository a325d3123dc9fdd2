// Checks the order of elimination and its tree against their definitions.

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

/// Supernodes follow one another without gaps; none is empty, and children precede parents.
void check_supernodes(const Dissection& found) {
  std::uint32_t place = 0;
  for (std::uint32_t p = 0; p < found.supernodes.size(); ++p) {
    const Dissection::Supernode& supernode = found.supernodes[p];
    CHECK(supernode.begin == place);
    CHECK(supernode.end > supernode.begin);
    CHECK(supernode.parent > p);  // kNoParent is larger than any
    place = supernode.end;
  }
  CHECK(place == found.order.size());
}

/// Whether `above` is `supernode` itself or one of its ancestors.
bool is_above(const Dissection& found, std::uint32_t above, std::uint32_t supernode) {
  while (supernode < above) supernode = found.supernodes[supernode].parent;
  return supernode == above;
}

/// Number of springs between two supernodes of which neither is an ancestor of the other: they
/// violate the separation.
int wrong_couplings(const Dissection& found, const MassSpringModel& model) {
  std::vector<std::uint32_t> supernode_of(model.node_count());
  for (std::uint32_t p = 0; p < found.supernodes.size(); ++p)
    for (std::uint32_t k = found.supernodes[p].begin; k < found.supernodes[p].end; ++k)
      supernode_of[found.order[k]] = p;
  int wrong = 0;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const auto [low, high] = std::minmax(supernode_of[model.a[s]], supernode_of[model.b[s]]);
    wrong += is_above(found, high, low) ? 0 : 1;
  }
  return wrong;
}

std::uint32_t size_of(const Dissection::Supernode& supernode) {
  return supernode.end - supernode.begin;
}

}  // namespace

TEST_CASE("A dissection orders every node once, children first, and its separators separate") {
  const MassSpringModel model =
      GENERATE(box_lattice(9, 7, 5), box_lattice(40, 2, 2), random_model(3, 6), random_model(1, 8));
  const Dissection found = dissected(model);
  check_order(found, model.node_count());
  check_supernodes(found);
  CHECK(found.supernodes.size() > 2);
  CHECK(wrong_couplings(found, model) == 0);
  CHECK(found.supernodes.back().parent == Dissection::kNoParent);
}

TEST_CASE("Of a lattice one layer of nodes is taken out, across its longest side") {
  const MassSpringModel model = box_lattice(21, 5, 5);
  const Dissection found = dissected(model);
  const Dissection::Supernode& top = found.supernodes.back();
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
  REQUIRE(one.supernodes.size() == two.supernodes.size());
  for (std::size_t p = 0; p < one.supernodes.size(); ++p) {
    CHECK(one.supernodes[p].begin == two.supernodes[p].begin);
    CHECK(one.supernodes[p].parent == two.supernodes[p].parent);
  }
}

TEST_CASE("A small body is one supernode, a body of no nodes has none") {
  const Dissection few = dissected(chain_of_nodes(10));
  check_order(few, 10);
  REQUIRE(few.supernodes.size() == 1);
  CHECK(few.supernodes[0].parent == Dissection::kNoParent);
  const Dissection none = dissect({}, {{0}, {}});
  CHECK(none.order.empty());
  CHECK(none.supernodes.empty());
}

TEST_CASE("Bodies side by side, loose nodes and nodes in one place are ordered too") {
  const MassSpringModel box = box_lattice(9, 7, 8);
  const MassSpringModel two = side_by_side(box, box, {20, 0, 0});
  const Dissection beside = dissected(two);
  check_order(beside, two.node_count());
  check_supernodes(beside);
  CHECK(wrong_couplings(beside, two) == 0);

  const Dissection apart = dissect(box.rest, {std::vector<std::uint32_t>(505, 0), {}});
  check_order(apart, 504);
  check_supernodes(apart);
  for (const Dissection::Supernode& supernode : apart.supernodes)  // nothing needs to be separated
    CHECK(supernode.parent == Dissection::kNoParent);

  const std::vector<Vec3> heap(504, Vec3(1, 2, 3));
  const Dissection together = dissect(heap, node_graph(stiffness_matrix(box)));
  check_order(together, 504);
  CHECK(together.supernodes.size() == 1);
}
