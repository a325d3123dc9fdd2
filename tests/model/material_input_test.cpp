#include "model/material_input.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <catch2/catch.hpp>

#include "base/error.hpp"

using namespace springlod;

TEST_CASE("A damping ratio becomes the time that damps the slowest vibration by it") {
  const MaterialInput input{.material = {.name = "m"}, .damping_ratio = 0.05};
  const double omega = 40;
  CHECK(resolved(input, omega).damping * omega / 2 == Approx(0.05));
  CHECK(resolved(input, 0).damping == 0);
}

TEST_CASE("A given damping time stays as it is, at any size") {
  const MaterialInput input{.material = {.name = "m", .damping = 0.003},
                            .damping_ratio = std::nullopt};
  CHECK(resolved(input, 40) == input.material);
  CHECK(resolved(input, 0) == input.material);
}

TEST_CASE("The default is a damping ratio of 1 %") {
  CHECK(resolved({{.name = "m"}}, 1).damping == Approx(0.02));
}

TEST_CASE("The lowest frequency is that of a free bar along its length") {
  CHECK(lowest_frequency_estimate(30, 0.5) == Approx(std::numbers::pi * 30 / 0.5));
}

TEST_CASE("A damping ratio outside 0 to 1 is rejected by name") {
  const auto with = [](double ratio) {
    return MaterialInput{.material = {.name = "jelly"}, .damping_ratio = ratio};
  };
  CHECK_NOTHROW(validate(with(0)));
  CHECK_NOTHROW(validate(with(0.999)));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double ratio : {-0.01, 1.0, HUGE_VAL, nan}) {
    CAPTURE(ratio);
    CHECK_THROWS_AS(validate(with(ratio)), InputError);
    CHECK_THROWS_WITH(validate(with(ratio)),
                      Catch::Contains("\"jelly\": damping_ratio") && Catch::Contains("below 1"));
  }
  CHECK_THROWS_AS(validate(MaterialInput{{.name = "jelly", .young = -1}}), InputError);
}
