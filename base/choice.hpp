#pragma once

#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace springlod::inline base {

/// One word that an option may take: its value, its name and its meaning.
template <class E>
struct Choice {
  using Value = E;
  E value;
  const char* name;
  const char* help;
};

/// All words of one enum, in the order in which help lists them. `Row` is a Choice or derives from
/// one, for enums whose values come with more than a name (see Grouping, Integrator).
template <class Row>
struct ChoiceTable {
  template <std::size_t n>
  constexpr ChoiceTable(const char* table_name, const Row (&table_rows)[n])
      : name(table_name), rows(table_rows) {}
  const char* name;  ///< name of the table in scripts: "border" for s.choices.border
  std::span<const Row> rows;
};

/// An enum with a table: `choices(E)` returns it and is declared beside the enum, where
/// argument-dependent lookup finds it. Names, parsing, help, documentation and completion all come
/// from that table.
template <class E>
concept HasChoices = std::is_enum_v<E> && requires(E value) {
  choices(value).rows;
};

/// The row of a value. Throws std::logic_error if the table lacks it.
template <HasChoices E>
const auto& choice_of(E value) {
  for (const auto& row : choices(value).rows)
    if (row.value == value) return row;
  throw std::logic_error(std::string("a value of ") + choices(value).name + " has no row");
}

/// The name of a value, as scripts write it.
template <HasChoices E>
const char* to_string(E value) {
  return choice_of(value).name;
}

/// The value of that name; empty if there is none.
template <HasChoices E>
std::optional<E> from_string(std::string_view name) {
  for (const auto& row : choices(E{}).rows)
    if (name == row.name) return row.value;
  return std::nullopt;
}

/// All values, in the order of the table.
template <HasChoices E>
std::vector<E> all_choices() {
  std::vector<E> values;
  for (const auto& row : choices(E{}).rows) values.push_back(row.value);
  return values;
}

}  // namespace springlod::inline base
