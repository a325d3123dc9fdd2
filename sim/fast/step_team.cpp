#include "sim/fast/step_team.hpp"

#include <thread>
#include <vector>

namespace springlod {

void StepTeam::run(const std::function<void(const Member&)>& work) const {
  if (size_ <= 1) {
    work({});
    return;
  }
  std::barrier<> meeting(size_);
  std::vector<std::thread> others;
  for (std::uint32_t number = 1; number < size_; ++number)
    others.emplace_back([&, number] { work({number, &meeting}); });
  work({0, &meeting});
  for (std::thread& thread : others) thread.join();
}

}  // namespace springlod
