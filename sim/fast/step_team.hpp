#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

namespace springlod {

/// Where threads wait for each other, a few microseconds at a time: waking a sleeping thread would
/// take longer than that, so they stay awake.
class MeetingPoint {
 public:
  explicit MeetingPoint(std::uint32_t size) : size_(size) {}
  void arrive_and_wait();

 private:
  std::uint32_t size_;
  std::atomic<std::uint32_t> arrived_{0};
  std::atomic<std::uint32_t> meetings_{0};
};

/// Threads that go through the same steps side by side.
class StepTeam {
 public:
  /// One of them at work.
  struct Member {
    std::uint32_t number = 0;
    MeetingPoint* others = nullptr;
    /// Waits until all have come here.
    void meet() const {
      if (others != nullptr) others->arrive_and_wait();
    }
  };

  explicit StepTeam(std::uint32_t size) : size_(size) {}
  std::uint32_t size() const { return size_; }
  /// Calls work(member) for each member, all at once; it must not throw.
  void run(const std::function<void(const Member&)>& work) const;

 private:
  std::uint32_t size_;
};

}  // namespace springlod
