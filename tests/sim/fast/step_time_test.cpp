#include "sim/fast/step_time.hpp"

#include <catch2/catch.hpp>

#include "lod/build.hpp"
#include "tests/support/bodies.hpp"

using namespace springlod;
using namespace springlod::sim;

TEST_CASE("A lattice runs in rows and its levels in quads, and its springs take less time each") {
  const MassSpringModel base = test::block(10, 10, 10);
  const MassSpringModel level =
      lod::simplify(base, {.levels = 1, .grouping = {.grouping = lod::Grouping::compact}})
          .levels[1]
          .model;
  for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
    const StepTime of_base = step_time(base, precision);
    const StepTime of_level = step_time(level, precision);
    CHECK(of_base.kernel == Kernel::rows);
    CHECK(of_level.kernel == Kernel::quads);
    CHECK(of_base.seconds / base.spring_count() < of_level.seconds / level.spring_count());
    CHECK(of_level.seconds < of_base.seconds);
  }
  CHECK(step_time(level, Precision::single_precision).seconds <
        step_time(level, Precision::double_precision).seconds);
}

TEST_CASE("The work of a step counts the gaps of rows and quads") {
  // A line of 16 nodes along x: one row of 8 springs, and one of 7 that ends in the next 8 places.
  const StepWork line = step_work(test::block(16, 1, 1), Precision::double_precision);
  CHECK(line.kernel == Kernel::rows);
  CHECK(line.eights == 2);
  CHECK(line.nodes == 16 + 8);
  const StepWork pair = step_work(test::block(2, 1, 1), Precision::double_precision);
  CHECK(pair.kernel == Kernel::quads);
  CHECK(pair.eights == 1);
  CHECK(pair.nodes == 2);
}

TEST_CASE("A spring takes longer in partly filled rows and in small models") {
  const LodChain chain = lod::simplify(
      test::block(4, 4, 23), {.levels = 2, .grouping = {.grouping = lod::Grouping::compact}});
  const MassSpringModel& base = chain.levels[0].model;
  const MassSpringModel& level = chain.levels[2].model;
  for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
    const StepWork work = step_work(level, precision);
    REQUIRE(work.kernel == Kernel::rows);
    REQUIRE(level.spring_count() < 5 * work.eights);
    const StepTime of_base = step_time(base, precision);
    const StepTime of_level = step_time(level, precision);
    CHECK(of_level.seconds / level.spring_count() > 1.3 * of_base.seconds / base.spring_count());
  }
}
