#pragma once

#include <algorithm>
#include <array>
#include <set>

#include <catch2/catch.hpp>

#include "model/corners.hpp"
#include "model/mass_spring.hpp"

namespace springlod::test {

/// What every model built here has: valid corners, whose six edges are springs, and no four nodes
/// with two corners.
inline void check_corners(const MassSpringModel& model) {
  REQUIRE_NOTHROW(validate(model));
  std::set<std::array<std::uint32_t, 4>> sets;
  for (const Corner& corner : model.corners) {
    std::array<std::uint32_t, 4> nodes = corner.node;
    std::sort(nodes.begin(), nodes.end());
    REQUIRE(sets.insert(nodes).second);
    REQUIRE(corner_shape(corner, model.rest) >= kFlatCorner);
  }
  CHECK(safe_strain(model) > 0);  // it is 0 if an edge is no spring
  CHECK(inverted_corners(model.corners, model.rest).empty());
}

}  // namespace springlod::test
