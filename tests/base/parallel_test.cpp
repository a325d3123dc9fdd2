// Jobs on several threads. Jobs wait for each other without time limits, so the order of events
// does not depend on the speed of the machine.

#include "base/parallel.hpp"

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

#include "base/error.hpp"

using namespace springlod;

namespace {

using Stopped = std::function<bool()>;

void wait_for(const std::atomic<bool>& event) {
  while (!event) std::this_thread::yield();
}

}  // namespace

TEST_CASE("Every job runs once, for any number of threads", "[threaded]") {
  const std::uint32_t threads = GENERATE(0U, 1U, 2U, 5U, 80U);
  std::vector<int> runs(50, 0), stops(50, 0);  // not atomic: no two threads may run the same job
  run_jobs(runs.size(), threads, [&](std::uint64_t job, const Stopped& stopped) {
    ++runs[job];
    stops[job] += stopped() ? 1 : 0;
  });
  CHECK(runs == std::vector<int>(50, 1));
  CHECK(stops == std::vector<int>(50, 0));
  run_jobs(0, threads, [](std::uint64_t, const Stopped&) { FAIL("there is no job"); });
}

TEST_CASE("One thread does the jobs in rising order, on the thread of the caller", "[threaded]") {
  std::vector<std::uint64_t> order;
  const std::thread::id caller = std::this_thread::get_id();
  run_jobs(5, 1, [&](std::uint64_t job, const Stopped&) {
    order.push_back(job);
    CHECK(std::this_thread::get_id() == caller);
  });
  CHECK(order == std::vector<std::uint64_t>{0, 1, 2, 3, 4});
}

TEST_CASE("The exception of the lowest failed job reaches the caller, with its type",
          "[threaded]") {
  const std::uint32_t threads = GENERATE(1U, 2U, 5U);
  const auto failing = [](std::uint64_t job, const Stopped&) {
    if (job == 7 || job == 8 || job == 30) throw InputError(std::to_string(job));
  };
  CHECK_THROWS_AS(run_jobs(50, threads, failing), InputError);
  CHECK_THROWS_WITH(run_jobs(50, threads, failing), "7");
}

TEST_CASE("Jobs after a failed one are not started, those under way are cancelled", "[threaded]") {
  std::atomic<bool> second_runs{false};
  std::atomic<int> started{0};
  const auto body = [&](std::uint64_t job, const Stopped& stopped) {
    ++started;
    if (job == 0) {
      wait_for(second_runs);
      throw IoError("the first");
    }
    second_runs = true;
    while (!stopped()) std::this_thread::yield();
    throw InterruptedError();
  };
  CHECK_THROWS_WITH(run_jobs(100, 2, body), "the first");
  CHECK(started == 2);
}

TEST_CASE("Jobs before a failed one go on, and one that fails then counts instead", "[threaded]") {
  std::atomic<bool> later_failed{false};
  bool told_to_stop = true;
  const auto body = [&](std::uint64_t job, const Stopped& stopped) {
    if (job == 1) {
      later_failed = true;
      throw InputError("later");
    }
    wait_for(later_failed);
    told_to_stop = stopped();
    throw InputError("earlier");
  };
  CHECK_THROWS_WITH(run_jobs(2, 2, body), "earlier");
  CHECK_FALSE(told_to_stop);
}

TEST_CASE("An interrupt stops the earlier jobs too", "[threaded]") {
  std::atomic<bool> first_runs{false};
  const auto body = [&](std::uint64_t job, const Stopped& stopped) {
    if (job == 1) {
      wait_for(first_runs);
      throw InterruptedError();
    }
    first_runs = true;
    while (!stopped()) std::this_thread::yield();
  };
  CHECK_THROWS_AS(run_jobs(2, 2, body), InterruptedError);
}
