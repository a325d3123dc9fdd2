#pragma once

#include <filesystem>
#include <string>

namespace springlod::report {

/// What came of drawing a picture through gnuplot.
struct Drawing {
  bool drawn = false;   ///< false: gnuplot is not installed
  std::string command;  ///< that draws it
};

/// Throws InputError unless the name ends in .svg or .png.
void require_picture_name(const std::filesystem::path& picture);

/// Where the script of a picture goes: NAME.gp beside it.
std::filesystem::path gnuplot_script_path(const std::filesystem::path& picture);

/// As a word in gnuplot's single quotes, where nothing is special but the quote.
std::string gnuplot_quoted(const std::string& text);

/// Size of a letter of one pixel: gnuplot counts pixels for svg, points (96 a 72nd inch) for png.
double gnuplot_font_unit(const std::filesystem::path& picture);

/// The lines with which a script begins: how to draw it again, and a white sheet of `width` by
/// `height` with letters of `font`, all in pixels.
std::string gnuplot_terminal(const std::filesystem::path& picture, double width, double height,
                             double font);

/// Writes the script and runs it. A script names its neighbours without a folder, so that script,
/// data and picture can be moved together. Throws IoError.
Drawing draw_with_gnuplot(const std::string& script, const std::filesystem::path& picture);

}  // namespace springlod::report
