#include "lod/grouping/light_groups.hpp"

#include <algorithm>
#include <utility>

#include <catch2/catch.hpp>

#include "lod/grouping/compact_groups.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/models.hpp"

using namespace springlod;
using namespace springlod::lod;

namespace {

std::vector<double> masses_of(const MassSpringModel& model, const Groups& groups) {
  std::vector<double> mass(groups.count, 0);
  for (std::uint32_t i = 0; i < model.node_count(); ++i) mass[groups.of[i]] += model.mass[i];
  return mass;
}

/// Nodes in a row at 0, 1, 2 ... m, joined by springs.
MassSpringModel row(const std::vector<double>& mass) {
  std::vector<Vec3> rest;
  std::vector<test::TableSpring> springs;
  for (std::uint32_t i = 0; i < mass.size(); ++i) {
    rest.emplace_back(i, 0, 0);
    if (i > 0) springs.push_back({i - 1, i, 1});
  }
  return test::table_model(rest, mass, springs);
}

/// Groups of the nodes of such a row after feeding the light ones of `of`.
std::vector<std::uint32_t> fed(const std::vector<double>& mass,
                               const std::vector<std::uint32_t>& kind,
                               std::vector<std::uint32_t> of) {
  Groups groups{std::move(of), 0};
  groups.count = 1 + *std::max_element(groups.of.begin(), groups.of.end());
  const std::uint32_t count = groups.count;
  feed_light_groups(row(mass), kind, groups);
  CHECK(groups.count == count);
  return groups.of;
}

using Nodes = std::vector<std::uint32_t>;

}  // namespace

TEST_CASE("A light group takes nodes of its neighbour until it is not light") {
  // The mean is 4.3. Two of the three rounds take a small node, the last one a large one.
  CHECK(fed({0.1, 0.2, 0.3, 4, 4}, {0, 0, 0, 0, 0}, {0, 1, 1, 1, 1}) == Nodes{0, 0, 0, 0, 1});
}

TEST_CASE("A light group takes no node whose group would become lighter than it was, or empty") {
  SECTION("lighter") {
    CHECK(fed({1, 2, 0.5, 20}, {0, 0, 0, 0}, {0, 1, 1, 2}) == Nodes{0, 1, 1, 2});
  }
  SECTION("empty") {
    CHECK(fed({1, 20}, {0, 0}, {0, 1}) == Nodes{0, 1});
  }
  SECTION("another kind") {
    CHECK(fed({1, 20, 20, 20}, {0, 1, 1, 0}, {0, 1, 1, 2}) == Nodes{0, 1, 1, 2});
  }
  SECTION("heavy enough") {
    CHECK(fed({3, 2, 2}, {0, 0, 0}, {0, 1, 1}) == Nodes{0, 1, 1});
  }
}

TEST_CASE("The groups of a lattice have even masses, though its border nodes are light") {
  // Nodes of its corners have an eighth of the mass of those inside.
  const MassSpringModel block = test::block(9, 9, 9, voxelize::LatticeStyle::corners);
  for (const double share : {0.45, 0.2}) {
    const auto count = static_cast<std::uint32_t>(share * block.node_count());
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const Groups groups = compact_groups(block, {.count = count, .seed = seed});
      CHECK(groups.count == count);
      const std::vector<double> mass = masses_of(block, groups);
      const double mean = 729.0 / count;  // of the block of 729 kg
      const auto light =
          std::count_if(mass.begin(), mass.end(), [&](double each) { return each < 0.45 * mean; });
      CHECK(light <= count / 50);
    }
  }
}
