#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

namespace springlod::sim {

// Threads wait for each other a few microseconds at a time: waking a sleeping thread would take
// longer than that, so they stay awake.

/// A barrier of all threads.
class MeetingPoint {
 public:
  explicit MeetingPoint(std::uint32_t size) : size_(size) {}
  void arrive_and_wait();

 private:
  std::uint32_t size_;
  std::atomic<std::uint32_t> arrived_{0};
  std::atomic<std::uint32_t> meetings_{0};
};

/// Progress of each part of the work, for threads that depend on each other's parts.
class Milestones {
 public:
  explicit Milestones(std::uint32_t parts) : reached_(parts) {}
  /// Call it from one thread while no other works.
  void reset();
  void reach(std::uint32_t part, std::uint32_t milestone) {
    reached_[part].store(milestone, std::memory_order_release);
  }
  void wait_for(std::uint32_t part, std::uint32_t milestone) const;

 private:
  std::vector<std::atomic<std::uint32_t>> reached_;
};

/// Threads that run the same steps in parallel.
class StepTeam {
 public:
  /// One thread of the team.
  struct Member {
    std::uint32_t number = 0;
    MeetingPoint* others = nullptr;
    /// Waits until all members have called it.
    void meet() const {
      if (others != nullptr) others->arrive_and_wait();
    }
  };

  explicit StepTeam(std::uint32_t size) : size_(size) {}
  std::uint32_t size() const { return size_; }
  /// Calls work(member) for all members in parallel; work must not throw.
  void run(const std::function<void(const Member&)>& work) const;

 private:
  std::uint32_t size_;
};

}  // namespace springlod::sim
