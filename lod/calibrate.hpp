#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "lod/elastic_targets.hpp"
#include "lod/fit_part.hpp"
#include "model/chain.hpp"
#include "model/progress.hpp"

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
  /// Time between two writes of a fit's state to the store [s], 0: after each step. A step of a
  /// large level takes seconds, its state is some megabytes. A fit that is interrupted or done
  /// writes its state in any case; one that is killed loses so much.
  double keep_every = 2;
  /// Levels that are fitted at a time, 0: as many as cores; of more than one each may take a second
  /// thread, for the levels differ much in size.
  std::uint32_t threads = 1;
  Progress* progress = nullptr;  ///< may be null
};

/// Fits every level but the base to the base: gives it the base's second moments of mass
/// (restore_second_moments), favours its long springs, and fits stiffnesses and masses (fit_part),
/// each connected part by itself. What is measured of the base is measured once.
/// The same bits for any number of threads, and from a store. Throws InputError where elastic_body
/// does, for regions that loads cannot move and a negative keep_every, IoError if the store cannot be written,
/// InterruptedError once `progress` asks to stop.
void calibrate(LodChain& chain, const CalibrateOptions& options = {});

}  // namespace springlod
