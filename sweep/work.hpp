#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sweep/unit_files.hpp"
#include "sweep/unit_result.hpp"

namespace springlod::sweep {

/// Computes the rows of a unit. What it throws is kept as the failure of the unit, except an
/// InterruptedError, which stops the work.
using UnitFunction = std::function<std::vector<Row>(std::uint64_t unit)>;

/// How the results of a process are labelled.
struct WorkLabels {
  std::string version{};  ///< of springlod
  std::string target{};   ///< instruction set
  std::string blas{};     ///< kernels of BLAS
  std::string log{};      ///< of this process, below the folder of the plan
};

/// Runs the units that another process, the one of run_units, asks for through `socket`, until
/// that process ends, and reports each unit. A unit that needs no run is left out. Throws
/// IoError if a result cannot be kept, InterruptedError if the user stops it; the unit in work then
/// counts as not run.
void serve_units(const UnitFiles& files, const WorkLabels& labels, const UnitFunction& run,
                 int socket);

}  // namespace springlod::sweep
