#pragma once

#include <filesystem>
#include <set>
#include <vector>

namespace springlod::scripting {

/// The files that a script may use: all, or, once restricted, those that were allowed. Paths are
/// compared without links and "..".
class FileAccess {
 public:
  void restrict() { restricted_ = true; }
  /// The folder of the user's project: all below it but hidden files and folders, whose names begin
  /// with a dot: they configure other programs (.git/hooks, .bashrc) or hold keys (.ssh).
  void allow_project(const std::filesystem::path& folder);
  /// What the user names, a file or a folder that need not exist, and what lies beside a file with
  /// the same stem, such as ball.calibration or ball-2.glb beside ball.glb; all below these.
  void allow_named(const std::filesystem::path& path);
  /// A folder, all below it, for reading.
  void allow_reading(const std::filesystem::path& folder);
  /// A folder of Lua modules of the system, for reading, and what its links lead to.
  void allow_modules(const std::filesystem::path& folder);

  bool may_read(const std::filesystem::path& path);
  bool may_write(const std::filesystem::path& path) const;
  /// Throw InputError, which says how to allow the path.
  void require_readable(const std::filesystem::path& path);
  void require_writable(const std::filesystem::path& path) const;

  /// All paths that were allowed to be read so far, without links: what results may depend on.
  const std::set<std::filesystem::path>& read() const { return read_; }

 private:
  struct Rule {
    std::filesystem::path path;
    bool writing = false;
    bool hidden = true;
    bool siblings = false;
    bool links = false;
  };
  struct Name;
  static bool covers(const Rule& rule, const Name& name);

  bool restricted_ = false;
  std::vector<Rule> rules_;
  std::set<std::filesystem::path> read_;
};

}  // namespace springlod::scripting
