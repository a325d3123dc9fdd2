#include "report/csv.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <string_view>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/file.hpp"

namespace springlod::report {
namespace {

void require_even(const Table& table) {
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    if (table.rows[r].size() != table.columns.size())
      throw InputError(fmt::format("table: row {} has {} cells, but there are {} columns", r + 1,
                                   table.rows[r].size(), table.columns.size()));
}

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\r\n") == std::string::npos) return cell;
  std::string out = "\"";
  for (const char c : cell) {
    if (c == '"') out += '"';
    out += c;
  }
  out += '"';
  return out;
}

void append_row(std::string& text, const std::vector<std::string>& cells) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) text += ',';
    text += quoted(cells[i]);
  }
  text += "\r\n";
}

// Width of UTF-8 text on a terminal: continuation bytes and combining accents
// (U+0300..U+036F: lead bytes CC, CD) count 0. Wide East Asian characters count 1.
std::size_t width(std::string_view text) {
  std::size_t columns = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool continues = (byte & 0xC0U) == 0x80;
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : '\0');
    const bool combining = byte == 0xCC || (byte == 0xCD && next < 0xB0);
    columns += continues || combining ? 0 : 1;
  }
  return columns;
}

// "12.5 %", "18.6x": texts that are aligned to the right, as numbers are.
bool starts_as_number(std::string_view text) {
  if (text == "nan" || text == "inf" || text == "-inf") return true;
  const std::size_t sign = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
  return text.size() > sign && text[sign] >= '0' && text[sign] <= '9';
}

bool is_number(const Cell& cell) {
  const auto* text = std::get_if<std::string>(&cell);
  return text == nullptr || starts_as_number(*text);
}

bool is_blank(const Cell& cell) {
  const auto* text = std::get_if<std::string>(&cell);
  return text != nullptr ? text->empty() || *text == "-"
                         : std::holds_alternative<std::monostate>(cell);
}

bool is_number_column(const Table& table, std::size_t column) {
  bool any = false;
  for (const auto& row : table.rows) {
    if (is_blank(row[column])) continue;
    if (!is_number(row[column])) return false;
    any = true;
  }
  return any;
}

using NumberText = std::string (*)(double);

std::string four_digits(double value) {
  return fmt::format("{:.4g}", value);
}

std::string cell_text(const Cell& cell, NumberText number) {
  if (const auto* whole_number = std::get_if<std::int64_t>(&cell))
    return fmt::format("{}", *whole_number);
  if (const auto* value = std::get_if<double>(&cell)) return number(*value);
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  return "";
}

std::vector<std::string> row_texts(const std::vector<Cell>& row, NumberText number) {
  std::vector<std::string> texts;
  for (const Cell& cell : row) texts.push_back(cell_text(cell, number));
  return texts;
}

}  // namespace

std::string number_text(double value) {
  std::array<char, 32> buffer{};  // no shortest representation has more than 24 characters
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end.ptr};
}

void save_csv(const Table& table, const std::filesystem::path& path) {
  require_even(table);
  std::string text;
  append_row(text, table.columns);
  for (const auto& row : table.rows) append_row(text, row_texts(row, number_text));
  write_text_file(path, text);
}

std::string format_table(const Table& table) {
  require_even(table);
  const std::size_t count = table.columns.size();
  std::vector<std::vector<std::string>> rows;
  for (const auto& row : table.rows) rows.push_back(row_texts(row, four_digits));
  std::vector<std::size_t> widths(count);
  std::vector<bool> right(count);
  for (std::size_t c = 0; c < count; ++c) {
    widths[c] = width(table.columns[c]);
    for (const auto& row : rows) widths[c] = std::max(widths[c], width(row[c]));
    right[c] = is_number_column(table, c);
  }
  std::string text;
  const auto append = [&](const std::vector<std::string>& cells) {
    std::string line;
    for (std::size_t c = 0; c < count; ++c) {
      const std::string padding(widths[c] - width(cells[c]), ' ');
      if (c > 0) line += "  ";
      line += right[c] ? padding + cells[c] : cells[c] + padding;
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  };
  append(table.columns);
  std::string rule;
  for (std::size_t c = 0; c < count; ++c) {
    if (c > 0) rule += "  ";
    for (std::size_t i = 0; i < widths[c]; ++i) rule += "\u2500";
  }
  text += rule + "\n";
  for (const auto& row : rows) append(row);
  return text;
}

}  // namespace springlod::report
