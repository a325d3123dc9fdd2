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
enum class Calibrate {
  none,    ///< as they were merged (the paper)
  moduli,  ///< see rescale_moduli
  modes,   ///< see calibrate
};

/// A row of its words, with what a level says of how it was made.
struct CalibrateChoice : Choice<Calibrate> {
  const char* remark;
};
inline constexpr CalibrateChoice kCalibrate[] = {
    {{Calibrate::none, "none", "levels stay as they were merged"}, ""},
    {{Calibrate::moduli, "moduli", "levels get the moduli of eq. 2 of the paper"},
     ", moduli rescaled"},
    {{Calibrate::modes, "modes",
      "levels get the base's frequencies and compliances, with as long a step as that allows, and "
      "carry a certificate of it"},
     ", calibrated"}};
constexpr ChoiceTable<CalibrateChoice> choices(Calibrate) {
  return {"calibrate", kCalibrate};
}

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
constexpr auto option_rows(const CalibrateOptions*) {
  return std::tuple(
      nested(&CalibrateOptions::targets), nested(&CalibrateOptions::fit),
      option("store", &CalibrateOptions::store,
             "folder that keeps what was found so far: a call that was stopped, or killed, goes on "
             "from there when it is made again, to the same bits; what is of another base, level "
             "or options is not used")
          .by_default("none"));
}

/// Fits every level but the base to the base: gives it the base's second moments of mass
/// (restore_second_moments), favours its long springs, and fits stiffnesses and masses (fit_part),
/// each connected part by itself. What is measured of the base is measured once.
/// The same bits for any number of threads, and from a store. Throws InputError where elastic_body
/// does and for regions that loads cannot move, IoError if the store cannot be written,
/// InterruptedError once `progress` asks to stop.
void calibrate(LodChain& chain, const CalibrateOptions& options = {});

}  // namespace springlod
