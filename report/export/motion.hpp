#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "base/choice.hpp"
#include "base/option.hpp"
#include "report/export/export.hpp"
#include "sim/run.hpp"

namespace springlod::report {

class MotionFiles;
struct MotionOptions;

/// A motion to write: a model with the frames of its run, which are sorted by time; at least one.
struct ExportedMotion {
  ExportedModel body;
  const std::vector<sim::Frame>& frames;
};

/// Files of other programs that hold the motion of a body.
enum class MotionFormat { glb, glb_morph, pc2, mdd, vtu, npz, obj };

/// A row of the table of formats; in the order in which help lists them.
struct MotionFormatChoice : Choice<MotionFormat> {
  const char* ending;  ///< of the main file, with the dot
  void (*write)(const ExportedMotion& motion, const MotionOptions& options, MotionFiles& files);
};
ChoiceTable<MotionFormatChoice> choices(MotionFormat);

struct MotionOptions {
  MotionFormat format = MotionFormat::glb;
  /// Frames per second [1/s]; none: those of the run.
  std::optional<double> frame_rate = std::nullopt;
  std::uint32_t influences = 4;  ///< largest number of joints of a skinned vertex
};
constexpr auto option_rows(const MotionOptions*) {
  return std::tuple(
      option("to", &MotionOptions::format, "format"),
      option("frame_rate", &MotionOptions::frame_rate,
             "frames per second, interpolated linearly between those of the run")
          .within(0.01, 10000)
          .by_default("those of the run"),
      option("influences", &MotionOptions::influences,
             "largest number of joints that move a vertex of a skinned glb; viewers know 4 or 8")
          .within(1, 8));
}

/// Writes a motion; `path` as for export_model. Sequences put their number before the ending. Every
/// file is whole or not there. Throws InputError for a format that needs the surface of a body that
/// has none, or more joints than it can number; IoError.
ExportReport export_motion(const ExportedMotion& motion, const std::filesystem::path& path,
                           const MotionOptions& options = {});

}  // namespace springlod::report
