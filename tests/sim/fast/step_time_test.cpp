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
