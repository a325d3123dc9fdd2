#pragma once

#include <barrier>
#include <cstdint>
#include <functional>

namespace springlod {

/// Threads that go through the same steps side by side.
class StepTeam {
 public:
  /// One of them at work.
  struct Member {
    std::uint32_t number = 0;
    std::barrier<>* others = nullptr;
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
