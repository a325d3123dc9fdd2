#include "base/processor_time.hpp"

#include <chrono>
#include <thread>

#include <catch2/catch.hpp>

using namespace springlod;

TEST_CASE("Processor time advances while the thread works, and not while it sleeps") {
  const double begin = processor_seconds();
  double now = begin;
  while (now < begin + 0.001) now = processor_seconds();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  CHECK(processor_seconds() - now < 0.05);
}
