#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/choice.hpp"
#include "model/material.hpp"
#include "model/vec.hpp"
#include "scripting/engine/api.hpp"

struct lua_State;

namespace springlod::scripting {

/// Reads a table of options and checks it against the registry. An unknown key in the script throws
/// InputError. An option that is read but not registered, or registered but never read, throws
/// std::logic_error, so that the documentation always matches the code.
class TableReader {
 public:
  /// `index`: stack index of the table; 0 or nil there means an empty table. `owner`: name for
  /// messages ("simplify").
  TableReader(lua_State* L, int index, const std::vector<Parameter>& listed, std::string owner);

  bool has(std::string_view name);
  // Each overload leaves `into` unchanged if the option is not given.
  void read(std::string_view name, bool& into);
  void read(std::string_view name, double& into);  ///< a number, or text with a unit
  void read(std::string_view name, std::string& into);
  void read(std::string_view name, Vec3& into);
  void read(std::string_view name, Colour& into);
  void read(std::string_view name, std::vector<std::string>& into);
  void read(std::string_view name, std::vector<double>& into);  ///< each element as a quantity
  void read(std::string_view name, std::vector<std::uint32_t>& into);
  void read(std::string_view name, std::filesystem::path& into);  ///< that may be written to
  template <class T>
  requires std::integral<T> &&(!std::same_as<T, bool>)void read(std::string_view name, T& into) {
    if (const auto value = whole_number(name, static_cast<double>(std::numeric_limits<T>::min()),
                                        static_cast<double>(std::numeric_limits<T>::max())))
      into = static_cast<T>(*value);
  }
  template <class T>
  void read(std::string_view name, std::optional<T>& into) {
    if (!has(name)) return;
    T value{};
    read(name, value);
    into = value;
  }
  /// Reads one word of the enum.
  template <HasChoices E>
  void read(std::string_view name, E& into) {
    choose(name, into, choices(into));
  }
  /// Reads a list of words of the enum.
  template <HasChoices E>
  void read(std::string_view name, std::vector<E>& into) {
    if (!has(name)) return;
    into.clear();
    for (const std::string& word : chosen_words(name, words_of<E>().names()))
      into.push_back(*from_string<E>(word));
  }
  /// Reads one word of `table`, for values of any type.
  template <class Value, class Row>
  void choose(std::string_view name, Value& into, const ChoiceTable<Row>& table) {
    const std::string word = chosen_word(name, words_of(table).names());
    for (const Row& row : table.rows)
      if (word == row.name) into = row.value;
  }
  /// Pushes the raw value and returns its stack index; pushes nothing and returns 0 if it is not
  /// given.
  int raw(std::string_view name);

  /// Throws std::logic_error if a registered option was never read.
  void finish() const;

  /// Throws InputError: "simplify: levels must be ...".
  [[noreturn]] void refuse(std::string_view name, const std::string& rule);
  const std::string& owner() const { return owner_; }
  lua_State* lua() const { return lua_; }

 private:
  const Parameter& listed(std::string_view name);
  /// Throws InputError for a number or a length of text outside of the option's range.
  void check_range(std::string_view name, double value);
  void check_text(std::string_view name, std::string_view text);
  void check_list(std::string_view name);  ///< the value on top
  bool get(std::string_view name);         // pushes the value and returns true if it is given
  std::optional<long long> whole_number(std::string_view name, double least, double most);
  /// Empty if the option is not given.
  std::string chosen_word(std::string_view name, const std::vector<std::string>& words);
  std::vector<std::string> chosen_words(std::string_view name,
                                        const std::vector<std::string>& words);
  void check_words(std::string_view name, const std::vector<std::string>& words);
  void check_keys();

  lua_State* lua_;
  int index_;
  const std::vector<Parameter>& listed_;
  std::vector<bool> asked_;
  std::string owner_;
};

}  // namespace springlod::scripting
