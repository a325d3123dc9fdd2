#include "base/available_memory.hpp"

#include <catch2/catch.hpp>
#include <sys/resource.h>

using namespace springlod;

TEST_CASE("Available memory is above none and below a petabyte") {
  CHECK(available_memory() > 1e6);
  CHECK(available_memory() < 1e15);
}

TEST_CASE("A limit of the address space counts") {
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_AS, &before) == 0);
  // A sanitizer reserves more than this, and then the limit leaves nothing.
  constexpr rlim_t kLimit = 1'000'000'000;
  const rlimit limited{kLimit, before.rlim_max};
  REQUIRE(setrlimit(RLIMIT_AS, &limited) == 0);
  const double available = available_memory();
  setrlimit(RLIMIT_AS, &before);
  CHECK(available < static_cast<double>(kLimit));
}
