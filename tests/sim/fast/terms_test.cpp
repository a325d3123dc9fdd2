// Dilatation terms in fast layouts, compared with the plain kernel.

#include <cmath>
#include <memory>

#include <catch2/catch.hpp>

#include "lod/build.hpp"
#include "sim/fast/fast_leapfrog.hpp"
#include "sim/fast/rows/row_layout.hpp"
#include "sim/integrators/leapfrog.hpp"
#include "tests/sim/side_by_side.hpp"
#include "tests/sim/vector_targets.hpp"

using namespace springlod;
using namespace springlod::sim;
using namespace springlod::test;

namespace {

/// A lattice, or a level of it, of which one material has terms above or below 0, and the other
/// such terms or none.
MassSpringModel soft_body(int side, double soft_poisson, double hard_poisson, bool merged) {
  const MassSpringModel lattice = two_material_block(side, soft_poisson, hard_poisson);
  return merged ? lod::simplify(lattice, {.levels = 1}).levels[1].model : lattice;
}

}  // namespace

TEST_CASE("Fast steps with terms are those of the plain kernel, to rounding, with their ledger") {
  const auto [soft, hard] =
      GENERATE(std::pair(0.45, 0.25), std::pair(0.4, 0.), std::pair(-0.1, 0.48));
  const bool merged = GENERATE(false, true);
  const MassSpringModel model = soft_body(9, soft, hard, merged);
  const Scenario scene = rough_scene(model);
  constexpr std::uint64_t kSteps = 300;
  const Outcome plain = after<Leapfrog>(model, scene, kSteps, {}, 1);
  REQUIRE(plain.contacts > 0);
  const double size = bounds(model.rest).sizes().norm();
  const Outcome fast = after<FastLeapfrog>(model, scene, kSteps, {}, 1);
  CHECK(largest_difference(plain.state.x, fast.state.x) < 1e-9 * size);
  CHECK(largest_difference(plain.state.v, fast.state.v) < 1e-7);
  const double energy = plain.ledger.total();
  for (const auto part : {&LedgerEntry::kinetic, &LedgerEntry::elastic, &LedgerEntry::lost_damping})
    CHECK(fast.ledger.*part == Approx(plain.ledger.*part).margin(1e-8 * std::abs(energy)));
  const Outcome single =
      after<FastLeapfrog>(model, scene, kSteps, {.precision = Precision::single_precision}, 1);
  CHECK(largest_difference(plain.state.x, single.state.x) < 1e-4 * size);
}

TEST_CASE("Fast steps with terms are those of the plain kernel on every kind of vectors") {
  const bool merged = GENERATE(false, true);
  const auto precision = GENERATE(Precision::single_precision, Precision::double_precision);
  const MassSpringModel model = soft_body(7, 0.45, 0.1, merged);
  const Scenario scene = rough_scene(model);
  constexpr std::uint64_t kFew = 50;
  const Outcome plain = after<Leapfrog>(model, scene, kFew, {}, 1);
  const double size = bounds(model.rest).sizes().norm();
  const double near = precision == Precision::double_precision ? 1e-11 : 1e-6;
  on_each_target([&] {
    const Outcome fast = after<FastLeapfrog>(model, scene, kFew, {.precision = precision}, 1000);
    CHECK(largest_difference(plain.state.x, fast.state.x) < near * size);
  });
}

TEST_CASE("Bodies of many blocks with terms move as in the plain kernel, on any number of threads",
          "[threaded]") {
  const bool merged = GENERATE(false, true);
  const MassSpringModel model = soft_body(merged ? 38 : 31, 0.45, 0.3, merged);
  REQUIRE(model.node_count() > 24'000);  // worth three threads
  const Scenario scene = rough_scene(model);
  constexpr std::uint64_t kFew = 20;
  const std::shared_ptr<const FastModel> layout =
      make_fast_model(model, Precision::double_precision);
  const auto on = [&](std::uint32_t threads) {
    return after<FastLeapfrog>(model, scene, kFew, {.threads = threads, .layout = layout}, 1000);
  };
  const Outcome one = on(1);
  check_same_bits(one, on(2));
  check_same_bits(one, on(3));
  const Outcome plain = after<Leapfrog>(model, scene, kFew, {}, 1);
  CHECK(largest_difference(plain.state.x, one.state.x) < 1e-12 * bounds(model.rest).sizes().norm());
}

TEST_CASE("Rows hold the term of every cell once and are nearly full on a lattice") {
  const MassSpringModel model = two_material_block(23, 0.45, 0.4);
  REQUIRE(has_terms_of_cells(model));
  const RowTerms<double> terms = make_row_layout<double>(model).dilatation;
  CHECK(model.dilatation.count() > 6 * terms.rows.size());
  CHECK(terms.shapes.size() == 1);
  double modulus = 0, expected = 0;
  for (const TermRow& row : terms.rows)
    for (const double each : terms.properties[row.properties].modulus) modulus += each;
  for (const double each : model.dilatation.modulus) expected += each;
  CHECK(modulus == Approx(expected));
  CHECK(!has_terms_of_cells(soft_body(9, 0.45, 0.45, true)));
}
