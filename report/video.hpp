#pragma once

#include <filesystem>
#include <string>

namespace springlod::report {

struct VideoResult {
  bool made = false;    ///< false: ffmpeg is not installed
  std::string command;  ///< command that encodes the frames
};

/// Encodes folder/frame_%04d.png to `path` (.mp4 or .gif) with ffmpeg, through a temporary file.
/// Throws IoError if ffmpeg fails, InputError for other extensions.
VideoResult encode_video(const std::filesystem::path& folder, double frame_rate,
                         const std::filesystem::path& path);

}  // namespace springlod::report
