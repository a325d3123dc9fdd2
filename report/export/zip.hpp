#pragma once

#include <string>
#include <vector>

namespace springlod::report {

/// A file in a zip archive.
struct ZipEntry {
  std::string name;
  std::string content;
};

/// The bytes of a zip archive, deflated. The same entries give the same bytes: all have the date
/// 1980-01-01. Throws InputError above 4 GiB, which needs another kind of archive.
std::string zip_archive(const std::vector<ZipEntry>& entries);

}  // namespace springlod::report
