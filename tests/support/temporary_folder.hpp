#pragma once

#include <filesystem>

namespace springlod::test {

/// A new folder. The destructor removes the folder with its contents.
class TemporaryFolder {
 public:
  /// Throws std::runtime_error if the folder cannot be made.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace springlod::test
