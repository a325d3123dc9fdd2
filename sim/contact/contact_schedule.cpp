#include "sim/contact/contact_schedule.hpp"

#include <numeric>

namespace springlod::sim {

void ContactSchedule::restart(std::uint32_t point_count, double bin) {
  bin_ = bin;
  bins_.assign(kBins, {});
  near_.resize(point_count);
  std::iota(near_.begin(), near_.end(), 0U);
}

void ContactSchedule::advance(double travel) {
  const auto to = static_cast<std::uint64_t>(travel / bin_);
  // After a turn of the wheel every bin is due.
  const std::uint64_t last = std::min(to, now_ + kBins);
  for (std::uint64_t due = now_ + 1; due <= last; ++due) {
    std::vector<std::uint32_t>& bin = bins_[due % kBins];
    near_.insert(near_.end(), bin.begin(), bin.end());
    bin.clear();
  }
  now_ = to;
}

}  // namespace springlod::sim
