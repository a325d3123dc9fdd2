#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace springlod::report {

/// Column names and rows of cells, all as text.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// Shortest decimal text that parses to the same double.
std::string number_text(double value);

/// Writes RFC 4180 to a temporary file and renames it. Throws IoError, and InputError if rows
/// differ in length.
void save_csv(const Table& table, const std::filesystem::path& path);
/// Aligns columns for a terminal; numbers are right-aligned.
std::string format_table(const Table& table);

}  // namespace springlod::report
