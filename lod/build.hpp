#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "lod/calibration/calibrate.hpp"
#include "lod/grouping/grouping.hpp"
#include "lod/merging/guard.hpp"
#include "lod/merging/merge.hpp"
#include "model/chain.hpp"

namespace springlod {

/// Makes the groups of one level from the model of the level before; replaces GroupingOptions.
using GroupMaker =
    std::function<Groups(const MassSpringModel& fine, const Groups& of_base, std::uint32_t level)>;

struct SimplifyOptions {
  std::uint32_t levels = 2;
  /// Nodes of each level over those of the base, falling; met exactly. Empty: as many as the
  /// grouping makes; straight from the base, 0.45, 0.2, 0.09, ...
  std::vector<double> keep{};
  GroupingOptions grouping{};
  /// Every level merged straight from the base, as those of compact and metis always are: no level
  /// has to do with what the one before merged.
  bool straight = false;
  MassRule mass = MassRule::proportional;
  bool guards = true;
  GuardOptions guard{};  ///< its border rule is taken from `grouping`
  GroupMaker groups{};   ///< optional
  Calibrate calibrate = Calibrate::none;
  CalibrateOptions calibration{};  ///< for Calibrate::modes
  std::string made_by{};           ///< left empty: told from the options
  Progress* progress = nullptr;
};
constexpr auto option_rows(const SimplifyOptions*) {
  return std::tuple(
      option("levels", &SimplifyOptions::levels,
             "levels besides the base, each merged from the one before"),
      option("keep", &SimplifyOptions::keep,
             "nodes of each level over those of the base, falling, met exactly; as many levels as "
             "there are numbers")
          .by_default("as the grouping makes; straight from the base 0.45, 0.2, ..."),
      nested(&SimplifyOptions::grouping),
      option("straight", &SimplifyOptions::straight,
             "each level is merged straight from the base, whatever the one before merged")
          .by_default("false; true of groupings that always are"),
      option("mass", &SimplifyOptions::mass, "where the mass of a group goes"),
      option("guards", &SimplifyOptions::guards,
             "fuse nodes that would coincide or be floppy; false: the raw merge"),
      record_option("guard", &SimplifyOptions::guard, "Guard",
                    "when a node counts as coincident or floppy", "the limits of Guard"),
      option("calibrate", &SimplifyOptions::calibrate, "what is done to levels after merging"),
      record_option("calibration", &SimplifyOptions::calibration, "Calibration",
                    "what calibrate = \"modes\" aims at", "that of Calibration"));
}

/// Level 0 = `base`, level n merged from level n-1 (or straight from the base), then all
/// of them calibrated against the base if asked for; with Calibrate::modes they are certified too.
/// Throws InputError if a level cannot get any
/// coarser (says which and why), or not have as many nodes as it should keep.
LodChain simplify(MassSpringModel base, const SimplifyOptions& options);

}  // namespace springlod
