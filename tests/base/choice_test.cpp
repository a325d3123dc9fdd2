#include "base/choice.hpp"

#include <catch2/catch.hpp>

namespace shop {

enum class Fruit { apple, pear, lost };

constexpr springlod::Choice<Fruit> kFruits[] = {{Fruit::pear, "pear", "the green one"},
                                                {Fruit::apple, "apple", "the red one"}};
constexpr springlod::ChoiceTable<springlod::Choice<Fruit>> choices(Fruit) {
  return {"fruit", kFruits};
}

struct PricedFruit : springlod::Choice<Fruit> {
  int price;
};

}  // namespace shop

using shop::Fruit;

TEST_CASE("a value of a choice has the name of its row, and a name the value") {
  CHECK(std::string(springlod::to_string(Fruit::apple)) == "apple");
  CHECK(springlod::from_string<Fruit>("pear") == Fruit::pear);
  CHECK_FALSE(springlod::from_string<Fruit>("plum").has_value());
  CHECK(springlod::all_choices<Fruit>() == std::vector<Fruit>{Fruit::pear, Fruit::apple});
}

TEST_CASE("a value without a row is refused") {
  CHECK_THROWS_AS(springlod::to_string(Fruit::lost), std::logic_error);
}

TEST_CASE("a row may hold more than a name") {
  static constexpr shop::PricedFruit kPriced[] = {{{Fruit::pear, "pear", "the green one"}, 3}};
  constexpr springlod::ChoiceTable table("fruit", kPriced);
  CHECK(table.rows.front().price == 3);
  CHECK_FALSE(springlod::HasChoices<int>);
}
