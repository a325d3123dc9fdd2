#include "sim/fast/step_team.hpp"

#include <thread>

namespace springlod::sim {

namespace {

// Polls before the core is yielded [1]: about 20 microseconds, longer than the waiting time between
// threads with equal work.
constexpr int kLooks = 10'000;

template <class Come>
void wait_until(Come come) {
  for (int look = 0; !come(); ++look)
    if (look >= kLooks) std::this_thread::yield();
}

}  // namespace

void MeetingPoint::arrive_and_wait() {
  const std::uint32_t meeting = meetings_.load(std::memory_order_relaxed);
  if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == size_) {
    arrived_.store(0, std::memory_order_relaxed);
    meetings_.store(meeting + 1, std::memory_order_release);
    return;
  }
  wait_until([&] { return meetings_.load(std::memory_order_acquire) != meeting; });
}

void Milestones::reset() {
  for (std::atomic<std::uint32_t>& one : reached_) one.store(0, std::memory_order_relaxed);
}

void Milestones::wait_for(std::uint32_t part, std::uint32_t milestone) const {
  wait_until([&] { return reached_[part].load(std::memory_order_acquire) >= milestone; });
}

void StepTeam::run(const std::function<void(const Member&)>& work) const {
  if (size_ <= 1) {
    work({});
    return;
  }
  MeetingPoint meeting(size_);
  std::vector<std::thread> others;
  for (std::uint32_t number = 1; number < size_; ++number)
    others.emplace_back([&, number] { work({number, &meeting}); });
  work({0, &meeting});
  for (std::thread& thread : others) thread.join();
}

}  // namespace springlod::sim
