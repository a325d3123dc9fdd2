#pragma once

#include <filesystem>
#include <string>

namespace springlod::report {

struct VideoResult {
  bool made = false;    ///< false: ffmpeg is not installed
  std::string command;  ///< that makes it from the frames
};

/// Encodes folder/frame_%04d.png as `path` (.mp4 or .gif) through ffmpeg, written aside and
/// renamed. Throws IoError if ffmpeg is there and fails, InputError for another ending.
VideoResult encode_video(const std::filesystem::path& folder, double frame_rate,
                         const std::filesystem::path& path);

}  // namespace springlod::report
