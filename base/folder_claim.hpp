#pragma once

#include <filesystem>
#include <string>

#include "base/descriptor.hpp"

namespace springlod::inline base {

/// Reserves a folder for the files of one run of a command. A file in it, .springlod-run, keeps the
/// name of the command and whether the run has finished. A lock on this file shows that the run
/// goes on; it ends with the process.
class FolderClaim {
 public:
  /// Makes the folder if it is missing. Throws InputError if another process has claimed it or it
  /// holds files of another command, IoError if it cannot be written to.
  FolderClaim(std::filesystem::path folder, std::string command);
  /// A folder without any files is left without the mark, and removed if it was made by the
  /// command.
  ~FolderClaim();
  FolderClaim(const FolderClaim&) = delete;
  FolderClaim& operator=(const FolderClaim&) = delete;

  /// Whether the folder holds files of an earlier run of the command that did not finish.
  bool continues() const { return continues_; }
  void finish();

 private:
  void take();
  void check_former();
  bool is_empty() const;

  std::filesystem::path folder_;
  std::string command_;
  bool made_ = false;  // the folder
  bool continues_ = false;
  Descriptor mark_{-1};
};

}  // namespace springlod::inline base
