#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "base/choice.hpp"
#include "base/option.hpp"
#include "base/progress.hpp"
#include "render/scene.hpp"
#include "report/filmed_run.hpp"

namespace springlod::report {

enum class CameraMode { fixed, follow };

inline constexpr Choice<CameraMode> kCameraModes[] = {
    {CameraMode::fixed, "fixed",
     "the same view in all panels, which shows how far apart the bodies are"},
    {CameraMode::follow, "follow", "each panel keeps its body in the middle"}};
constexpr ChoiceTable<Choice<CameraMode>> choices(CameraMode) {
  return {"camera", kCameraModes};
}

/// Of a film, unless `frames` ask for less [1/s].
inline constexpr double kUsualFrameRate = 30;
/// Less must be a typing error [1/s].
inline constexpr double kLeastFrameRate = 0.01;

struct AnimateOptions {
  std::uint32_t width = 640;  ///< of one panel [px]
  std::uint32_t height = 480;
  std::uint32_t columns = 0;  ///< panels in a row; 0: all of them
  /// [1/s]; frames are 1 / (frame_rate * slow) simulated seconds apart. Empty: kUsualFrameRate, or
  /// less so that `frames` show all of the runs.
  std::optional<double> frame_rate = {};
  double slow = 1;  ///< slow motion: 4 plays four times slower than real time
  /// Maximum number of frames; with a frame_rate, the film ends after them. 0: no limit.
  std::uint32_t frames = 0;
  /// fixed: one view of the whole motion, or one for each run of bodies that differ in size;
  /// follow: each panel keeps its body in the middle.
  CameraMode camera = CameraMode::fixed;
  double azimuth = -70;  ///< of the eye, from x towards y [deg]
  double elevation = 15;
  /// Mirrors the azimuth if a wall would hide the motion from the camera.
  bool avoid_walls = true;
  /// Levels to draw of each chain that was compared, 0 for the base; empty: all.
  std::vector<std::uint32_t> levels = {};
  render::DrawStyle style = {};
  Progress* progress = nullptr;
};
constexpr auto option_rows(const AnimateOptions*) {
  using Options = AnimateOptions;
  return std::tuple(
      option("width", &Options::width, "width of a panel in pixels").within(1, 16384),
      option("height", &Options::height, "height of a panel in pixels").within(1, 16384),
      option("columns", &Options::columns, "number of panels in a row")
          .within(1, 1000)
          .by_default("all in one row"),
      option("frame_rate", &Options::frame_rate, "frames per second of the video")
          .within(kLeastFrameRate, 1000)
          .by_default("30, or less so that `frames` show all of the runs"),
      option("slow", &Options::slow, "slow motion; 4: four times slower than real time")
          .within(0.001, 1e6),
      option("frames", &Options::frames,
             "maximum number of frames; if frame_rate is given, the film ends after them")
          .within(1, 1e6)
          .by_default("all"),
      option(
          "camera", &Options::camera,
          "whether the camera follows the body. A fixed one has one view for all panels, but one "
          "for each if the bodies differ in size by more than a factor 1.5"),
      option("azimuth", &Options::azimuth,
             "azimuth of the camera about the vertical, from x, in degrees")
          .within(-360, 360),
      option("elevation", &Options::elevation, "elevation of the camera, in degrees")
          .within(-90, 90),
      option("avoid_walls", &Options::avoid_walls,
             "mirror the azimuth if a wall would hide the motion"),
      option("levels", &Options::levels, "levels to draw of each comparison; 0 is the base")
          .within(0, 1000)
          .by_default("all"));
}

struct Animation {
  std::uint32_t frames = 0;
  double frame_rate = kUsualFrameRate;  ///< at which it has the speed that was asked for [1/s]
  std::filesystem::path folder;
};

/// Draws the runs side by side, synchronized, as folder/frame_0000.png ... Positions between the
/// frames of a run are interpolated linearly. A run that ended before others keeps its last frame,
/// and its panel says so. If the style shows only things that a body lacks (such as a surface),
/// nodes and springs are drawn. Removes surplus frame_*.png of an earlier, longer animation. Throws
/// InputError (no runs; a run with no frames but the first and the last) and IoError.
Animation animate(const std::vector<FilmedRun>& runs, const std::filesystem::path& folder,
                  const AnimateOptions& options = {});

/// The same of the base of the first chain and the levels of all. Throws InputError as filmed_runs
/// does, too.
Animation animate(const std::vector<ComparedChain>& chains, const std::filesystem::path& folder,
                  const AnimateOptions& options = {});

}  // namespace springlod::report
