#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace springlod::inline base {

/// Calls `write` with a temporary path beside `path`, then renames it to `path`. Readers see either
/// the old file or the complete new one. Creates missing folders. If `write` throws, the temporary
/// file is removed and `path` is unchanged. Throws IoError.
void write_aside(const std::filesystem::path& path,
                 const std::function<void(const std::filesystem::path&)>& write);
/// Writes through write_aside; throws IoError.
void write_text_file(const std::filesystem::path& path, std::string_view text);
/// All bytes. Throws IoError, also for a folder.
std::string read_file(const std::filesystem::path& path);

/// 64-bit xxh3 hash as 16 hexadecimal digits.
std::string content_hash(std::string_view bytes);

}  // namespace springlod::inline base
