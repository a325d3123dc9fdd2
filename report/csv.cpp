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

// A text table that is at most kTableWidth wide if its words allow it: titles, and then the longest
// column of texts, continue on further lines.
class TextTable {
 public:
  explicit TextTable(const Table& table) : columns_(table.columns.size()) {
    for (const auto& row : table.rows) rows_.push_back(row_texts(row, four_digits));
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      Column& column = columns_[c];
      column.title = table.columns[c];
      column.right = is_number_column(table, c);
      for (const auto& row : rows_) column.widest = std::max(column.widest, width(row[c]));
      column.width = std::max(column.widest, width(column.title));
    }
    while (total_width() > kTableWidth && narrow_a_title()) {
    }
    if (total_width() > kTableWidth) narrow_the_texts();
  }

  std::string text() const {
    std::vector<std::string> titles;
    for (const Column& column : columns_) titles.push_back(column.title);
    std::string text = lines_of(titles);
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      if (c > 0) text += "  ";
      for (std::size_t i = 0; i < columns_[c].width; ++i) text += "\u2500";
    }
    text += "\n";
    for (const auto& row : rows_) text += lines_of(row);
    return text;
  }

 private:
  static constexpr std::size_t kTableWidth = 100;
  struct Column {
    std::string title;
    bool right = false;
    std::size_t widest = 0;  // of its cells
    std::size_t width = 0;
  };

  std::size_t total_width() const {
    std::size_t total = columns_.empty() ? 0 : 2 * (columns_.size() - 1);
    for (const Column& column : columns_) total += column.width;
    return total;
  }

  // Takes one from the column whose title is most wider than its cells.
  bool narrow_a_title() {
    Column* most = nullptr;
    const auto excess = [](const Column& column) {
      std::size_t least = column.widest;
      for (const std::string& word : wrapped(column.title, 1)) least = std::max(least, width(word));
      return column.width - std::min(column.width, least);
    };
    for (Column& column : columns_)
      if (excess(column) > (most == nullptr ? 0 : excess(*most))) most = &column;
    if (most == nullptr) return false;
    --most->width;
    return true;
  }

  void narrow_the_texts() {
    const auto widest =
        std::max_element(columns_.begin(), columns_.end(),
                         [](const Column& a, const Column& b) { return a.width < b.width; });
    if (widest->right) return;
    constexpr std::size_t kLeast = 20;
    const std::size_t others = total_width() - widest->width;
    widest->width = std::max(kLeast, kTableWidth > others ? kTableWidth - others : 0);
    for (const auto& row : rows_)  // a long word stays whole
      for (const std::string& line :
           wrapped(row[static_cast<std::size_t>(widest - columns_.begin())], widest->width))
        widest->width = std::max(widest->width, width(line));
  }

  // `text` in lines of at most `most` columns, or of one word.
  static std::vector<std::string> wrapped(const std::string& text, std::size_t most) {
    if (width(text) <= most) return {text};
    std::vector<std::string> lines{""};
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find(' ', at), text.size());
      const std::string word = text.substr(at, end - at);
      if (!lines.back().empty() && width(lines.back()) + 1 + width(word) > most)
        lines.emplace_back();
      lines.back() += (lines.back().empty() ? "" : " ") + word;
      at = end + 1;
    }
    return lines;
  }

  std::string lines_of(const std::vector<std::string>& cells) const {
    std::vector<std::vector<std::string>> parts;
    std::size_t count = 1;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      parts.push_back(wrapped(cells[c], columns_[c].width));
      count = std::max(count, parts.back().size());
    }
    std::string text;
    for (std::size_t n = 0; n < count; ++n) {
      std::string line;
      for (std::size_t c = 0; c < cells.size(); ++c) {
        const std::string part = n < parts[c].size() ? parts[c][n] : "";
        const std::string padding(columns_[c].width - std::min(columns_[c].width, width(part)),
                                  ' ');
        if (c > 0) line += "  ";
        line += columns_[c].right ? padding + part : part + padding;
      }
      line.erase(line.find_last_not_of(' ') + 1);
      text += line + "\n";
    }
    return text;
  }

  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

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
  return TextTable(table).text();
}

}  // namespace springlod::report
