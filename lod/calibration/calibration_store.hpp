#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "lod/calibration/elastic_targets.hpp"
#include "lod/calibration/fit_part.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// A folder with the state of a calibration, from which a stopped calibration resumes: the
/// measurements of each component of the base, and the state of the fit of each level and
/// component. The files are binary, in the format of the machine. Each holds a fingerprint of its
/// inputs and a checksum. A file with another fingerprint, or a damaged one, is reported, ignored
/// and replaced. Several threads may use different files.
class CalibrationStore {
 public:
  /// Makes the folder if it is missing. Throws IoError if it cannot be written, as `keep` does.
  CalibrationStore(std::filesystem::path folder, Progress* progress);

  std::optional<BaseMeasurements> measurements(std::size_t part,
                                               const std::string& fingerprint) const;
  void keep(std::size_t part, const std::string& fingerprint,
            const BaseMeasurements& measured) const;

  std::optional<FitState> fit(std::size_t level, std::size_t part,
                              const std::string& fingerprint) const;
  void keep(std::size_t level, std::size_t part, const std::string& fingerprint,
            const FitState& state) const;

  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path place(const std::string& name) const;
  /// The payload of a file; none if there is no valid file with this fingerprint.
  std::optional<std::string> read(const std::string& name, const std::string& fingerprint) const;
  void write(const std::string& name, const std::string& fingerprint,
             const std::string& payload) const;

  std::filesystem::path folder_;
  Progress* progress_;
};

/// Hash of all inputs of the measurements of a component of the base for some levels.
std::string fingerprint_of(const MassSpringModel& base_part, const TargetOptions& options,
                           const std::vector<Groups>& levels);
/// Hash of all inputs of the fit of a component of a level; `level_part` is the component before
/// the fit.
std::string fingerprint_of(const ElasticTargets& targets, const MassSpringModel& level_part,
                           const Groups& of_base, const FitOptions& options);

}  // namespace springlod::lod
