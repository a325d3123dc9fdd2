#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "model/chain.hpp"
#include "render/scene.hpp"
#include "sim/study/compare.hpp"

namespace springlod {

enum class CameraMode { fixed, follow };

struct AnimateOptions {
  std::uint32_t width = 640;  ///< of one panel [px]
  std::uint32_t height = 480;
  double frame_rate = 30;    ///< of the pictures: 1 / frame_rate / slow simulated seconds apart
  double slow = 1;           ///< 4: four times slower than life
  std::uint32_t frames = 0;  ///< at most, from the start; 0: all
  /// fixed: one view that holds the whole action; follow: each panel keeps its body in the middle.
  CameraMode camera = CameraMode::fixed;
  double azimuth = -70;  ///< of the eye, from x towards y [deg]
  double elevation = 15;
  /// Mirror the azimuth where a wall would else stand between the camera and the action.
  bool avoid_walls = true;
  DrawStyle style = {};
  Progress* progress = nullptr;
};

struct Animation {
  std::uint32_t frames = 0;
  std::filesystem::path folder;
};

/// Draws base and levels side by side on one clock as folder/frame_0000.png ... Frames are
/// written while the next are drawn. Positions between the frames of a trajectory are interpolated
/// linearly; a run that ended early holds its last frame. A style that asks for nothing that is
/// there (a surface where the asset has none) draws nodes and springs. frame_*.png of an earlier,
/// longer animation are removed. Throws InputError (no runs, asset and runs that do not belong
/// together), IoError.
Animation animate(const LodAsset& asset, const Comparison& comparison,
                  const std::filesystem::path& folder, const AnimateOptions& options = {});

}  // namespace springlod
