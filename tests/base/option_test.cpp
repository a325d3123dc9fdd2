#include "base/option.hpp"

#include <string>

#include <catch2/catch.hpp>

using springlod::Dimension;

namespace shop {

struct Inner {
  double length = 2;
  int count = 3;
};
constexpr auto option_rows(const Inner*) {
  return std::tuple(
      springlod::option("length", &Inner::length, "how long").in(Dimension::length).weight(),
      springlod::option("count", &Inner::count, "how many"));
}

struct Outer {
  bool fast = true;
  Inner inner;
  Inner table;
  std::vector<std::uint32_t> held;
  int hidden = 0;
};
constexpr auto option_rows(const Outer*) {
  return std::tuple(springlod::option("fast", &Outer::fast, "whether").by_default("it depends"),
                    springlod::nested(&Outer::inner),
                    springlod::record_option("table", &Outer::table, "Inner", "more", "none"),
                    springlod::nodes_option("held", &Outer::held, "which", "none"));
}

}  // namespace shop

TEST_CASE("every row of an options struct is visited in order, nested ones in their place") {
  const shop::Outer outer;
  std::string names;
  springlod::for_each_option(
      outer, [&](const auto& row, const auto&) { names += std::string(row.name) + " "; });
  CHECK(names == "fast length count table held ");
}

TEST_CASE("a row reaches its member, and says of which dimension it is") {
  shop::Inner inner;
  springlod::for_each_option(inner, [](const auto& row, auto& member) {
    if (row.dimension == Dimension::length) {
      CHECK(row.is_weight);
      CHECK(member == 2);
      member = 5;
    }
  });
  CHECK(inner.length == 5);
  CHECK(inner.count == 3);
  CHECK_FALSE(springlod::HasOptions<int>);
}
