#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace springlod::report {

/// A cell of a table: nothing, a whole number, a number, or text. It becomes text only where the
/// table is written.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;

/// Column names and rows of as many cells.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;
};

/// A count as a cell; `value` < 2^63.
inline Cell whole(std::uint64_t value) {
  return static_cast<std::int64_t>(value);
}

/// Shortest decimal text that parses to the same double.
std::string number_text(double value);

/// RFC 4180; numbers by number_text, nothing as an empty cell. Written under a temporary name and
/// renamed. Throws IoError, InputError for a ragged table.
void save_csv(const Table& table, const std::filesystem::path& path);
/// Columns aligned for a terminal. Numbers have four digits; they and texts that start with a
/// number ("12.5 %") are aligned to the right. Throws InputError for a ragged table.
std::string format_table(const Table& table);

}  // namespace springlod::report
