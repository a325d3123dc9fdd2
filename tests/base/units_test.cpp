#include "base/units.hpp"

#include <catch2/catch.hpp>

#include "base/error.hpp"

namespace springlod {
namespace {

using Catch::Matchers::Contains;

TEST_CASE("Quantities are parsed with their unit, with or without a space") {
  CHECK(parse_quantity("5 mm", Dimension::length, "cell") == 0.005);
  CHECK(parse_quantity(" 5mm ", Dimension::length, "cell") == 0.005);
  CHECK(parse_quantity("5", Dimension::length, "cell") == 5);
  CHECK(parse_quantity("+1e3 kg/m3", Dimension::density, "density") == 1000);
  CHECK(parse_quantity("1.2 g/cm^3", Dimension::density, "density") == Approx(1200));
  CHECK(parse_quantity("0.2 MPa", Dimension::pressure, "young") == Approx(2e5));
  CHECK(parse_quantity("36 km/h", Dimension::velocity, "speed") == Approx(10));
  CHECK(parse_quantity("60rpm", Dimension::angular_velocity, "spin") == Approx(6.283185307));
  CHECK(parse_quantity("-90 deg", Dimension::angle, "turn") == Approx(-1.570796327));
  CHECK(parse_quantity("-9.81 m/s^2", Dimension::acceleration, "gravity") == -9.81);
  CHECK(parse_quantity("2 min", Dimension::time, "duration") == 120);
  CHECK(parse_quantity("3 t", Dimension::mass, "mass") == 3000);
  CHECK(parse_quantity("1 in", Dimension::length, "cell") == 0.0254);
  CHECK(parse_quantity("0.25", Dimension::number, "safety") == 0.25);
  CHECK(parse_quantity("2 %", Dimension::number, "error") == 0.02);
  CHECK(parse_quantity("150%", Dimension::number, "error") == 1.5);
  CHECK(parse_quantity("2e-3", Dimension::length, "cell") == 0.002);
}

TEST_CASE("An unknown unit is rejected with the list of known ones") {
  CHECK_THROWS_WITH(parse_quantity("5 parsec", Dimension::length, "cell"),
                    Contains("cell") && Contains("parsec") && Contains("mm") && Contains("ft"));
  CHECK_THROWS_WITH(parse_quantity("5 mm", Dimension::pressure, "young"),
                    Contains("young") && Contains("MPa"));
  CHECK_THROWS_WITH(parse_quantity("5 mm", Dimension::number, "levels"), Contains("plain number"));
  CHECK_THROWS_AS(parse_quantity("5 MM", Dimension::length, "cell"), InputError);
  CHECK_THROWS_WITH(length_unit("furlong"), Contains("furlong") && Contains("km"));
}

TEST_CASE("Text that is not a number is rejected") {
  for (const char* text : {"", "mm", "five mm", "nan", "inf m", "1e999", "1e308 km", "--5"})
    CHECK_THROWS_AS(parse_quantity(text, Dimension::length, "cell"), InputError);
}

TEST_CASE("Quantities are formatted with a suitable SI prefix") {
  CHECK(format_quantity(0.002, Dimension::length) == "2 mm");
  CHECK(format_quantity(1e7, Dimension::pressure) == "10 MPa");
  CHECK(format_quantity(0, Dimension::pressure) == "0 Pa");
  CHECK(format_quantity(-0.25, Dimension::length) == "-250 mm");
  CHECK(format_quantity(999.99, Dimension::pressure) == "1 kPa");
  CHECK(format_quantity(1000, Dimension::density) == "1000 kg/m3");
  CHECK(format_quantity(0.0123456, Dimension::mass) == "12.35 g");
  CHECK(format_quantity(3e-12, Dimension::length) == "0.003 nm");
  CHECK(format_quantity(0.3, Dimension::number) == "0.3");
  CHECK(format_quantity(1.5e-3, Dimension::time) == "1.5 ms");
}

TEST_CASE("Formatted quantities are parsed to the same value") {
  for (const Dimension d : {Dimension::length, Dimension::time, Dimension::mass,
                            Dimension::pressure, Dimension::density, Dimension::velocity})
    for (const double value : {1e-7, 0.5, 12.0, 4.2e5})
      CHECK(parse_quantity(format_quantity(value, d), d, "value") == Approx(value));
}

TEST_CASE("Each dimension has its SI unit") {
  CHECK(si_unit(Dimension::number).empty());
  CHECK(si_unit(Dimension::density) == "kg/m3");
  CHECK(si_unit(Dimension::angular_velocity) == "rad/s");
  CHECK(length_unit("mm") == 1e-3);
}

}  // namespace
}  // namespace springlod
