#include "voxelize/enough_memory.hpp"

#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "base/error.hpp"

namespace springlod::voxelize {

TEST_CASE("More cells than the memory holds are refused with a cell that fits") {
  // No machine has 1e18 bytes.
  std::string message;
  try {
    require_memory_of_cells("lattice", 1e15, 1000, 0.001);
  } catch (const InputError& error) {
    message = error.what();
  }
  CHECK_THAT(message, Catch::Matchers::StartsWith("lattice: 1e+15 cells of 0.001 m need 1e+09 GB"));
  const std::string before = "use a cell of ";
  const std::size_t at = message.find(before);
  REQUIRE(at != std::string::npos);
  const double fits = std::stod(message.substr(at + before.size()));
  CHECK(fits > 0.001);
  const double cells = 1e15 * std::pow(0.001 / fits, 3);
  CHECK_NOTHROW(require_memory_of_cells("lattice", cells, 1000, fits));
}

TEST_CASE("What fits is accepted") {
  CHECK_NOTHROW(require_memory_of_cells("lattice", 10, 1000, 0.1));
}

}  // namespace springlod::voxelize
