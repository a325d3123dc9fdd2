#pragma once

#include <cstdint>
#include <string>

#include <catch2/catch.hpp>
#include <hwy/targets.h>

#include "sim/fast/fast_model.hpp"

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

}  // namespace springlod::test
