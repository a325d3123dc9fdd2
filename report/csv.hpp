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

/// Shortest decimal form that reads back as the same double.
std::string number_text(double value);

/// RFC 4180; written aside and renamed. Throws IoError, InputError for a ragged table.
void save_csv(const Table& table, const std::filesystem::path& path);
/// Columns aligned for a terminal; numbers to the right.
std::string format_table(const Table& table);

}  // namespace springlod::report
