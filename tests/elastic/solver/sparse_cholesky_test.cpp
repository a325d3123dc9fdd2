#include "elastic/solver/sparse_cholesky.hpp"

#include <algorithm>
#include <numeric>

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>

#include "elastic/solver/random_block.hpp"
#include "elastic/stiffness.hpp"
#include "tests/elastic/elastic_samples.hpp"
#include "tests/support/models.hpp"

namespace springlod::elastic {
namespace {

Eigen::SparseMatrix<double> shifted_stiffness(const MassSpringModel& m, double shift) {
  Eigen::SparseMatrix<double> k = stiffness_matrix(m);
  for (Eigen::Index i = 0; i < k.rows(); ++i) k.coeffRef(i, i) += shift;
  return k;
}

/// Whether `above` is the piece itself or one on the way from it to its top.
bool is_above(const Dissection& d, std::uint32_t piece, std::uint32_t above) {
  while (piece != above && piece != Dissection::kNoParent) piece = d.pieces[piece].parent;
  return piece == above;
}

void check_dissection(const Dissection& d, const NodeGraph& graph) {
  const std::size_t nodes = graph.start.size() - 1;
  std::vector<std::uint32_t> sorted = d.order;
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::uint32_t> all(nodes);
  std::iota(all.begin(), all.end(), 0U);
  REQUIRE(sorted == all);

  std::vector<std::uint32_t> piece_of(nodes);
  std::uint32_t next = 0;
  for (std::uint32_t p = 0; p < d.pieces.size(); ++p) {
    CHECK(d.pieces[p].begin == next);
    CHECK(d.pieces[p].end > d.pieces[p].begin);
    CHECK(d.pieces[p].parent > p);
    next = d.pieces[p].end;
    for (std::uint32_t k = d.pieces[p].begin; k < next; ++k) piece_of[d.order[k]] = p;
  }
  CHECK(next == nodes);
  bool separated = true;
  for (std::uint32_t i = 0; i < nodes; ++i)
    for (std::uint32_t e = graph.start[i]; e < graph.start[i + 1]; ++e) {
      const auto [low, high] = std::minmax(piece_of[i], piece_of[graph.neighbour[e]]);
      separated = separated && is_above(d, low, high);
    }
  CHECK(separated);
}

TEST_CASE("A dissection couples pieces to those above and below them alone") {
  const MassSpringModel box = test::box_lattice(9, 7, 8);
  SECTION("of a lattice") {
    const NodeGraph graph = node_graph(stiffness_matrix(box));
    const Dissection d = dissect(box.rest, graph);
    check_dissection(d, graph);
    // The first cut takes out one layer across the longest axis.
    CHECK(d.pieces.back().end - d.pieces.back().begin == 7 * 8);
  }
  SECTION("of an uneven model") {
    const MassSpringModel m = test::random_model(1, 8);
    const NodeGraph graph = node_graph(stiffness_matrix(m));
    check_dissection(dissect(m.rest, graph), graph);
  }
  SECTION("of two bodies, which no separator holds together") {
    const MassSpringModel m = test::side_by_side(box, box, {20, 0, 0});
    const NodeGraph graph = node_graph(stiffness_matrix(m));
    const Dissection d = dissect(m.rest, graph);
    check_dissection(d, graph);
  }
  SECTION("of points that all lie in one place") {
    const NodeGraph graph = node_graph(stiffness_matrix(box));
    const Dissection d = dissect(std::vector<Vec3>(box.rest.size(), Vec3::Zero()), graph);
    check_dissection(d, graph);
    CHECK(d.pieces.size() == 1);
  }
}

TEST_CASE("Solving with the factors is solving with the matrix") {
  const std::uint64_t seed = GENERATE(1U, 2U);
  const int n = GENERATE(2, 4, 7);
  const MassSpringModel m = test::random_model(seed, n);
  const auto matrix = shifted_stiffness(m, 10);
  const SparseCholesky factor(matrix, m.rest);
  REQUIRE(factor.positive());
  const Eigen::MatrixXd b = random_block(matrix.rows(), 5, seed);
  const Eigen::MatrixXd expected = Eigen::MatrixXd(matrix).llt().solve(b);
  CHECK((factor.solve(b) - expected).norm() < 1e-12 * expected.norm());
  // One at a time as well.
  CHECK((factor.solve(b.col(2)) - expected.col(2)).norm() < 1e-12 * expected.norm());
}

TEST_CASE("Bodies that hang together by nothing are solved side by side") {
  const MassSpringModel m =
      test::side_by_side(test::box_lattice(5, 5, 5), test::box_lattice(4, 5, 6), {0.5, 0.5, 0.5});
  const auto matrix = shifted_stiffness(m, 1);
  const SparseCholesky factor(matrix, m.rest);
  REQUIRE(factor.positive());
  const Eigen::MatrixXd b = random_block(matrix.rows(), 1, 1);
  CHECK((matrix * factor.solve(b) - b).norm() < 1e-12 * b.norm());
}

TEST_CASE("A matrix that is not positive definite is told") {
  const MassSpringModel m = test::random_model(3, 5);
  CHECK_FALSE(SparseCholesky(shifted_stiffness(m, -1), m.rest).positive());
}

}  // namespace
}  // namespace springlod::elastic
