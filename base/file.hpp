#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace springlod::inline base {

/// Whether a file is on the disk, with its content, before it has its name. Syncing takes some
/// milliseconds a file. Without it, a file that was written just before a power failure may be
/// empty afterwards.
enum class Durability {
  synced,    ///< a file that a later run relies on
  unsynced,  ///< one of many files that are quickly made again, such as the frames of a video
};

/// Calls `write` with a temporary path beside `path`, which is an empty file with the extension of
/// `path`, then renames it to `path`. Readers see either the old file or the complete new one.
/// Creates missing folders. Follows links: the file that `path` leads to is replaced. A device or
/// pipe is written to itself. If `write` throws, the temporary file is removed and `path` is
/// unchanged; temporary files that processes left when they were killed are removed too. Throws
/// IoError.
void write_aside(const std::filesystem::path& path,
                 const std::function<void(const std::filesystem::path&)>& write,
                 Durability durability = Durability::synced);
/// Writes through write_aside; throws IoError.
void write_text_file(const std::filesystem::path& path, std::string_view text);
/// All bytes. Throws IoError, also for a folder.
std::string read_file(const std::filesystem::path& path);

/// 64-bit xxh3 hash as 16 hexadecimal digits.
std::string content_hash(std::string_view bytes);

}  // namespace springlod::inline base
