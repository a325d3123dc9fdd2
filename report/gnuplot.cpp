#include "report/gnuplot.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/subprocess.hpp"

namespace springlod::report {

namespace fs = std::filesystem;

namespace {

// A complete picture has the mark of its end within its last bytes [bytes].
constexpr std::size_t kEnd = 16;

// gnuplot does not say that the disk was full.
void require_complete(const fs::path& aside, const fs::path& picture) {
  const std::string bytes = read_file(aside);
  const std::string end = bytes.substr(bytes.size() - std::min(bytes.size(), kEnd));
  if (end.find(picture.extension() == ".svg" ? "</svg>" : "IEND") == std::string::npos)
    throw IoError(
        fmt::format("cannot write {}: gnuplot wrote only a part of it; is there space on the disk?",
                    picture.string()));
}

}  // namespace

void require_picture_name(const fs::path& picture) {
  if (picture.extension() != ".svg" && picture.extension() != ".png")
    throw InputError(fmt::format("chart: {} must end in .svg or .png", picture.string()));
}

fs::path gnuplot_script_path(const fs::path& picture) {
  return fs::path(picture).replace_extension(".gp");
}

std::string gnuplot_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') out += '\'';
    out += c == '\n' || c == '\r' ? ' ' : c;  // a line break would end the command
  }
  out += '\'';
  return out;
}

double gnuplot_font_unit(const fs::path& picture) {
  return picture.extension() == ".svg" ? 1 : 0.75;
}

std::string gnuplot_terminal(const fs::path& picture, double width, double height, double font) {
  std::string text = "# Made by springlod. Draws " + picture.filename().string() +
                     " again: gnuplot " + picture.stem().string() + ".gp\n";
  // noenhanced: "_" and "^" in names are not markup.
  text += "set encoding utf8\n";
  if (picture.extension() == ".svg")
    text += fmt::format(
        "set terminal svg size {},{} font 'sans-serif,{}' background rgb 'white' noenhanced "
        "name 'chart'\n",
        width, height, font);
  else
    text += fmt::format("set terminal pngcairo size {},{} font 'DejaVu Sans,{}' noenhanced\n",
                        width, height, font * gnuplot_font_unit(picture));
  // The output file can be set: gnuplot -e "picture='other.svg'" ...
  text += fmt::format("if (!exists('picture')) picture = {}\nset output picture\n",
                      gnuplot_quoted(picture.filename().string()));
  return text;
}

Drawing draw_with_gnuplot(const std::string& script, const fs::path& picture) {
  const fs::path file = gnuplot_script_path(picture);
  write_text_file(file, script);
  const fs::path folder = picture.has_parent_path() ? picture.parent_path() : fs::path(".");
  Drawing drawing;
  drawing.command = "cd " + shell_word(folder.string()) + " && " +
                    shell_line("gnuplot", {file.filename().string()});
  const auto gnuplot = find_program("gnuplot");
  if (!gnuplot) return drawing;
  write_aside(picture, [&](const fs::path& aside) {
    const std::string output = "picture=" + gnuplot_quoted(fs::absolute(aside).string());
    const ProgramResult run =
        run_program(*gnuplot, {"-e", output, file.filename().string()}, folder);
    if (run.exit_code != 0)
      throw IoError(fmt::format("gnuplot failed (exit {}) on {}:\n{}\nThe command was: {}",
                                run.exit_code, file.string(), run.errors, drawing.command));
    require_complete(aside, picture);
  });
  drawing.drawn = true;
  return drawing;
}

}  // namespace springlod::report
