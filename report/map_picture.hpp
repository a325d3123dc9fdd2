#pragma once

#include <filesystem>
#include <string>

#include "report/gnuplot.hpp"
#include "sim/study/stability_map.hpp"

namespace springlod::report {

struct MapPictureOptions {
  std::string title;
};

/// Draws a stability map: a panel for each level and integrator, stiffness ratios from left to
/// right, steps upwards, the error as colour, hatched where a run diverged, the predicted limit as
/// a line. Through gnuplot, whose script stays beside the picture. Throws InputError (no points;
/// not .svg or .png), IoError.
Drawing draw_map(const sim::StabilityMap& map, const MapPictureOptions& options,
                 const std::filesystem::path& path);

}  // namespace springlod::report
