#include "base/range.hpp"

#include <limits>

#include <catch2/catch.hpp>

using springlod::Dimension;
using springlod::Range;

TEST_CASE("A range includes its ends, but not NaN") {
  constexpr Range range{1, 100};
  CHECK(range.contains(1));
  CHECK(range.contains(100));
  CHECK_FALSE(range.contains(0.999));
  CHECK_FALSE(range.contains(std::numeric_limits<double>::infinity()));
  CHECK_FALSE(range.contains(std::numeric_limits<double>::quiet_NaN()));
}

TEST_CASE("A range is printed with all digits and with units") {
  CHECK(to_string(Range{1, 16384}, Dimension::number) == "1 to 16384");
  CHECK(to_string(Range{1e-3, 100}, Dimension::time) == "1 ms to 100 s");
}
