#pragma once

#include <filesystem>
#include <string>

#include "report/gnuplot.hpp"
#include "sim/study/stability_map.hpp"

namespace springlod::report {

/// Draws a stability map with gnuplot: one panel per level and integrator, stiffness ratio on the
/// horizontal axis, time step on the vertical axis, error as colour, hatching where a run diverged,
/// and a line at the predicted limit. The script is kept beside the picture. Throws InputError (no
/// points; not .svg or .png) and IoError.
Drawing draw_map(const sim::StabilityMap& map, const std::string& title,
                 const std::filesystem::path& path);

}  // namespace springlod::report
