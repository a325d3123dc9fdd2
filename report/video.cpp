#include "report/video.hpp"

#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/subprocess.hpp"
#include "render/frames.hpp"
#include "report/csv.hpp"

namespace springlod::report {
namespace {

namespace fs = std::filesystem;

// ffmpeg interprets % in a file name as the frame number.
std::string frame_pattern(const fs::path& folder) {
  std::string escaped;
  for (const char c : folder.string()) escaped += c == '%' ? std::string("%%") : std::string(1, c);
  return (fs::path(escaped) / "frame_%04d.png").string();
}

std::vector<std::string> mp4_options() {
  // yuv420p and even sides: supported by all players and browsers. bt709: otherwise players differ
  // in the colours of small videos. crf 20: no visible loss. bitexact: no version or time in the
  // file, so that equal frames give equal bytes.
  return {"-vf",
          "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white,scale=out_color_matrix=bt709",
          "-c:v",
          "libx264",
          "-pix_fmt",
          "yuv420p",
          "-crf",
          "20",
          "-preset",
          "fast",
          "-colorspace",
          "bt709",
          "-color_primaries",
          "bt709",
          "-color_trc",
          "bt709",
          "-movflags",
          "+faststart",
          "-bitexact"};
}

std::vector<std::string> gif_options() {
  // One palette for the whole video; ordered dithering compresses best.
  return {
      "-vf",
      "split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=bayer:bayer_scale=4",
      "-loop", "0", "-bitexact"};
}

std::vector<std::string> ffmpeg_arguments(const fs::path& folder, double frame_rate,
                                          const fs::path& path) {
  // xerror: otherwise a full disk is no failure.
  std::vector<std::string> arguments{"-nostdin",
                                     "-y",
                                     "-xerror",
                                     "-loglevel",
                                     "error",
                                     "-framerate",
                                     number_text(frame_rate),
                                     "-i",
                                     frame_pattern(folder)};
  const auto options = path.extension() == ".gif" ? gif_options() : mp4_options();
  arguments.insert(arguments.end(), options.begin(), options.end());
  // A name that starts with a dash would be parsed as an option.
  const std::string name = path.string();
  arguments.push_back(name.starts_with('-') ? "./" + name : name);
  return arguments;
}

}  // namespace

VideoResult encode_video(const fs::path& folder, double frame_rate, const fs::path& path) {
  if (path.extension() != ".mp4" && path.extension() != ".gif")
    throw InputError(fmt::format("video: {} must end in .mp4 or .gif", path.string()));
  if (!(frame_rate > 0) || !std::isfinite(frame_rate))
    throw InputError(fmt::format("video: a frame rate of {} must be above 0", frame_rate));
  if (!fs::exists(render::frame_path(folder, 0)))
    throw InputError(fmt::format("video: {} does not exist; draw the frames first",
                                 render::frame_path(folder, 0).string()));
  VideoResult result;
  result.command = shell_line("ffmpeg", ffmpeg_arguments(folder, frame_rate, path));
  const auto ffmpeg = find_program("ffmpeg");
  if (!ffmpeg) return result;
  write_aside(path, [&](const fs::path& aside) {
    const ProgramResult run = run_program(*ffmpeg, ffmpeg_arguments(folder, frame_rate, aside));
    if (run.exit_code != 0)
      throw IoError(fmt::format("ffmpeg failed (exit {}) on {}:\n{}\nThe command was: {}",
                                run.exit_code, path.string(), run.errors, result.command));
  });
  result.made = true;
  return result;
}

}  // namespace springlod::report
