#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "model/chain.hpp"
#include "model/progress.hpp"
#include "render/scene.hpp"
#include "sim/compare.hpp"

namespace springlod {

enum class CameraMode { fixed, follow };

struct AnimateOptions {
  std::uint32_t width = 640;  ///< of one panel [px]
  std::uint32_t height = 480;
  double frame_rate = 30;    ///< of the pictures, per simulated second / slow
  double slow = 1;           ///< 4: four times slower than life
  std::uint32_t frames = 0;  ///< at most; 0: all
  CameraMode camera = CameraMode::fixed;
  double azimuth = -70;  ///< [deg]
  double elevation = 15;
  DrawStyle style;
  Progress* progress = nullptr;
};

struct Animation {
  std::uint32_t frames = 0;
  std::filesystem::path folder;
};

/// Draws base and levels side by side on one clock as folder/frame_0000.png ... Each frame is
/// written while the next is drawn.
Animation animate(const LodAsset& asset, const Comparison& comparison,
                  const std::filesystem::path& folder, const AnimateOptions& options = {});

}  // namespace springlod
