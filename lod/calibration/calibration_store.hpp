#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "base/progress.hpp"
#include "lod/calibration/elastic_targets.hpp"
#include "lod/calibration/fit_part.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// A folder that keeps what a calibration has found so far, so that one that was stopped goes on
/// where it was: what was measured of each part of the base, and for each level and part the state
/// of its fit. Files are binary, for this machine; each holds the fingerprint of all that it
/// depends on, and a checksum. One that is of something else, or damaged, is not used, which is
/// said, and written anew. Different files may be used from several threads.
class CalibrationStore {
 public:
  /// Makes the folder if it is missing. Throws IoError if nothing can be written there, as all that
  /// write do.
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
  /// What is in a file, without what is around it.
  std::optional<std::string> read(const std::string& name, const std::string& fingerprint) const;
  void write(const std::string& name, const std::string& fingerprint,
             const std::string& payload) const;

  std::filesystem::path folder_;
  Progress* progress_;
};

/// Of all that the answers of a part of the base depend on.
std::string fingerprint_of(const MassSpringModel& base_part, const TargetOptions& options);
/// Of all that the fit of a part of a level depends on; `level_part` as the fit starts from it.
std::string fingerprint_of(const ElasticTargets& targets, const MassSpringModel& level_part,
                           const Groups& of_base, const FitOptions& options);

}  // namespace springlod::lod
