#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <catch2/catch.hpp>
#include <hwy/targets.h>

#include "sim/fast/vector_target.hpp"

namespace springlod::test {

/// Calls act() with the kernels limited to each kind of vectors that this processor has, from the
/// newest to the oldest.
template <class Act>
void on_each_target(const Act& act) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    CAPTURE(hwy::TargetName(target));
    hwy::DisableTargets(target - 1);  // newer instruction sets have lower bits
    CHECK(std::string(sim::vector_target()) == hwy::TargetName(target));
    act();
    hwy::DisableTargets(0);
  }
}

/// Calls check(a, b) with what make() returns on targets that should give the same bits: those that
/// fuse products, and those that do not. In builds with sanitizers no target does.
template <class Make, class Check>
void hold_targets_together(const Make& make, const Check& check) {
  std::optional<decltype(make())> fused, separate;
  on_each_target([&] {
    auto found = make();
    auto& first = sim::fuses_products() ? fused : separate;
    if (first)
      check(*first, found);
    else
      first = std::move(found);
  });
}

}  // namespace springlod::test
