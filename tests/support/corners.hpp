#pragma once

#include <algorithm>
#include <array>
#include <set>
#include <utility>

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
  std::set<std::pair<std::uint32_t, std::uint32_t>> springs;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) springs.emplace(model.a[s], model.b[s]);
  for (const Corner& corner : model.corners)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j)
        REQUIRE(springs.count(std::minmax(corner.node[i], corner.node[j])) == 1);
  CHECK(inverted_corners(model.corners, model.rest).empty());
}

}  // namespace springlod::test
