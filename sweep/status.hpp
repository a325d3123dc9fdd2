#pragma once

#include <cstdint>
#include <vector>

#include "sweep/plan.hpp"
#include "sweep/unit_files.hpp"

namespace springlod::sweep {

struct Status {
  std::uint64_t units = 0;
  std::uint64_t done = 0;
  std::uint64_t running = 0;
  std::uint64_t failed = 0;   ///< by themselves
  std::uint64_t lost = 0;     ///< given up
  std::uint64_t missing = 0;  ///< the others: not run yet, or to be tried again
  double seconds_left = 0;    ///< of one core, estimated [s]
};

Status status_of(const Plan& plan, const UnitFiles& files);

/// The tasks with units that are missing or waiting to be tried again, counted from 0.
std::vector<std::size_t> unfinished_tasks(const Plan& plan, const UnitFiles& files);

}  // namespace springlod::sweep
