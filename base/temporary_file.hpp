#pragma once

#include <filesystem>

#include "base/descriptor.hpp"

namespace springlod::inline base {

/// The file in which another file of its folder is prepared. A lock that ends with the process
/// shows that it is still in use. Throws std::system_error.
class TemporaryFile {
 public:
  /// Makes an empty one. Some writers choose the format by the extension.
  TemporaryFile(const std::filesystem::path& folder, const std::filesystem::path& extension);
  /// Removes it, unless it was renamed.
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Waits until its content is on the disk.
  void sync() const;
  void rename_to(const std::filesystem::path& target);

 private:
  std::filesystem::path path_;  // empty after rename_to
  Descriptor file_{-1};
};

/// Removes the temporary files in a folder that no process uses any more. Errors are ignored.
void remove_stale_temporaries(const std::filesystem::path& folder);

}  // namespace springlod::inline base
