#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/progress.hpp"
#include "lod/calibration/elastic_targets.hpp"
#include "lod/calibration/fit_part.hpp"
#include "model/chain.hpp"

namespace springlod {

/// What is done to levels after merging.
enum class Calibration {
  none,    ///< as they were merged (the paper)
  moduli,  ///< see rescale_moduli
  modes,   ///< see calibrate
};

struct CalibrateOptions {
  TargetOptions targets{};
  FitOptions fit{};
  /// Folder that keeps what was found so far (CalibrationStore): a calibration that was stopped
  /// goes on from there when it is made again, to the same bits. Empty: nothing is kept.
  std::filesystem::path store{};
  /// Levels that are fitted at a time, 0: as many as cores; of more than one each may take a second
  /// thread, for the levels differ much in size.
  std::uint32_t threads = 1;
  Progress* progress = nullptr;  ///< may be null
};

/// Fits every level but the base to the base: gives it the base's second moments of mass
/// (restore_second_moments), favours its long springs, and fits stiffnesses and masses (fit_part),
/// each connected part by itself. What is measured of the base is measured once.
/// The same bits for any number of threads, and from a store. Throws InputError where elastic_body
/// does and for regions that loads cannot move, IoError if the store cannot be written,
/// InterruptedError once `progress` asks to stop.
void calibrate(LodChain& chain, const CalibrateOptions& options = {});

}  // namespace springlod
