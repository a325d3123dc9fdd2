// The thread team of the fast steps. The members share non-atomic memory: the thread sanitizer, or
// a different result, reveals missing synchronization.

#include "sim/fast/step_team.hpp"

#include <cstdint>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

using namespace springlod::sim;

namespace {

using Values = std::vector<std::uint64_t>;

std::uint64_t mixed(std::uint64_t left, std::uint64_t own, std::uint64_t right) {
  return 6364136223846793005ULL * (own + 3 * left + 5 * right) + 1442695040888963407ULL;
}

/// A ring of parts on one thread. In every step, each part is computed from itself and its two
/// neighbours.
Values stepped(Values values, std::uint32_t steps) {
  const std::size_t n = values.size();
  for (std::uint32_t step = 0; step < steps; ++step) {
    const Values old = values;
    for (std::size_t p = 0; p < n; ++p)
      values[p] = mixed(old[(p + n - 1) % n], old[p], old[(p + 1) % n]);
  }
  return values;
}

Values first_values(std::size_t parts) {
  Values values(parts);
  for (std::size_t p = 0; p < parts; ++p) values[p] = 1000 + p;
  return values;
}

}  // namespace

TEST_CASE("A team calls its work once for each member, the first on the thread of the caller",
          "[threaded]") {
  const std::uint32_t size = GENERATE(1U, 2U, 5U);
  std::vector<int> calls(size, 0);
  std::vector<std::thread::id> thread(size);
  StepTeam(size).run([&](const StepTeam::Member& member) {
    ++calls[member.number];
    thread[member.number] = std::this_thread::get_id();
  });
  CHECK(calls == std::vector<int>(size, 1));
  CHECK(thread[0] == std::this_thread::get_id());
  for (std::uint32_t number = 1; number < size; ++number) CHECK(thread[number] != thread[0]);
}

TEST_CASE("Nobody leaves a meeting before all have come, however often they meet", "[threaded]") {
  const std::uint32_t size = GENERATE(1U, 2U, 3U, 5U);
  constexpr int kMeetings = 300;
  std::vector<int> round(size, 0);
  std::vector<int> wrong(size, 0);
  StepTeam(size).run([&](const StepTeam::Member& member) {
    for (int r = 1; r <= kMeetings; ++r) {
      round[member.number] = r;
      member.meet();
      for (const int each : round) wrong[member.number] += each != r ? 1 : 0;
      member.meet();
    }
  });
  CHECK(wrong == std::vector<int>(size, 0));
}

TEST_CASE("Steps that wait for their neighbours' milestones come to what one thread comes to",
          "[threaded]") {
  const std::uint32_t size = GENERATE(1U, 2U, 3U, 5U);
  constexpr std::uint32_t kParts = 7, kSteps = 300;
  const Values wanted = stepped(first_values(kParts), kSteps);
  // Values of the previous and the present step: a neighbour may be one step ahead, never two.
  std::vector<Values> values{first_values(kParts), Values(kParts)};
  Milestones done(kParts);
  StepTeam(size).run([&](const StepTeam::Member& member) {
    for (std::uint32_t step = 1; step <= kSteps; ++step) {
      const Values& old = values[(step + 1) % 2];
      for (std::uint32_t p = member.number; p < kParts; p += size) {
        const std::uint32_t left = (p + kParts - 1) % kParts, right = (p + 1) % kParts;
        done.wait_for(left, step - 1);
        done.wait_for(right, step - 1);
        values[step % 2][p] = mixed(old[left], old[p], old[right]);
        done.reach(p, step);
      }
    }
  });
  CHECK(values[kSteps % 2] == wanted);

  done.reset();
  done.wait_for(0, 0);  // at once
}

TEST_CASE("A part that is further than asked for is not waited for", "[threaded]") {
  Milestones done(2);
  done.reach(1, 5);
  for (const std::uint32_t milestone : {0U, 3U, 5U}) done.wait_for(1, milestone);
  SUCCEED();
}
