#pragma once

#include <filesystem>
#include <string>

namespace springlod::report {

/// Result of drawing with gnuplot.
struct Drawing {
  bool drawn = false;   ///< false: gnuplot is not installed
  std::string command;  ///< command that runs the script
};

/// Throws InputError unless the file name ends in .svg or .png.
void require_picture_name(const std::filesystem::path& picture);

/// Path of the script of a picture: NAME.gp beside it.
std::filesystem::path gnuplot_script_path(const std::filesystem::path& picture);

/// `text` in gnuplot's single quotes, with quotes escaped.
std::string gnuplot_quoted(const std::string& text);

/// gnuplot font size of 1 px: svg sizes are in pixels, png sizes in points (72 per 96 px).
double gnuplot_font_unit(const std::filesystem::path& picture);

/// The first lines of a script: output file, terminal, and a white sheet of `width` by `height`
/// with font size `font`, all in pixels.
std::string gnuplot_terminal(const std::filesystem::path& picture, double width, double height,
                             double font);

/// Writes the script and runs it. The script refers to its data and picture by name without folder,
/// so that the files can be moved together. Throws IoError.
Drawing draw_with_gnuplot(const std::string& script, const std::filesystem::path& picture);

}  // namespace springlod::report
