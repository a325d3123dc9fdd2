#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sweep/plan.hpp"

// Tasks of a plan as array jobs of Slurm.

namespace springlod::sweep {

struct SlurmOptions {
  std::filesystem::path program{};                ///< springlod, at the same path on every node
  std::vector<std::string> options{};             ///< further ones of sbatch, "--partition=short"
  std::uint32_t at_once = 0;                      ///< largest number of tasks at a time; 0: any
  double seconds = 0;                             ///< limit of a task [s]; 0: from the plan
  std::uint64_t memory = std::uint64_t{2} << 30;  ///< of a task [bytes]
};

/// One call of sbatch.
struct SlurmJob {
  std::vector<std::string> arguments{};  ///< of sbatch, without its dependency
  std::size_t phase = 0;
};

/// Array jobs for the given tasks, a phase after the other, each with at most `largest_array`
/// tasks; then one that merges. An array begins when those of the phase before have ended, however
/// they ended.
std::vector<SlurmJob> slurm_jobs(const Plan& plan, const std::filesystem::path& folder,
                                 const std::vector<std::size_t>& tasks, std::uint64_t largest_array,
                                 const SlurmOptions& options);

/// The jobs as a script for a shell, with their numbers in variables.
std::string slurm_script(const std::vector<SlurmJob>& jobs);

/// Gives the jobs to Slurm and returns their numbers. Throws IoError with the message of sbatch;
/// jobs that were already given are then cancelled.
std::vector<std::string> submit_to_slurm(const std::vector<SlurmJob>& jobs);

/// MaxArraySize of the cluster. If there is no Slurm, or it does not answer: the usual one if
/// `guess`, else throws IoError.
std::uint64_t largest_slurm_array(bool guess);

}  // namespace springlod::sweep
