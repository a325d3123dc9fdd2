#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/material.hpp"
#include "scripting/engine/session.hpp"
#include "scripting/engine/value.hpp"

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

/// The arguments of one call of an API function, checked against its registry entry.
class Call {
 public:
  Call(lua_State* L, const FunctionEntry& entry);

  lua_State* lua() const { return lua_; }
  Session& session() const { return session_; }
  Progress* progress() const { return session_.progress(); }

  bool has(int number) const;
  /// Stack index of argument `number`, counted from 1.
  int index(int number) const;

  template <class T>
  std::shared_ptr<const T> value(int number) const {
    auto found = std::static_pointer_cast<const T>(boxed_at(lua_, index(number), &kValueName<T>));
    if (!found) refuse(number, std::string("a ") + kValueName<T>);
    return found;
  }
  /// Null if argument `number` is of another type.
  template <class T>
  std::shared_ptr<const T> try_value(int number) const {
    return std::static_pointer_cast<const T>(boxed_at(lua_, index(number), &kValueName<T>));
  }
  template <class T>
  std::shared_ptr<const T> self() const {
    auto found = std::static_pointer_cast<const T>(boxed_at(lua_, 1, &kValueName<T>));
    if (!found) refuse_self();
    return found;
  }
  std::string text(int number) const;
  /// A path that the script may read, or write to; throws InputError otherwise.
  std::filesystem::path readable(int number) const;
  std::filesystem::path writable(int number) const;
  /// An integer in [least, most]; throws InputError otherwise.
  long long integer(int number, long long least, long long most) const;
  /// The optional table of options at argument `number`.
  TableReader options(int number) const;
  /// A table at `index` with the keys of a registered record.
  TableReader record(int index, std::string_view record, std::string owner) const;

  /// Throws InputError: "bad argument 1 (mesh) of voxelize: expected a Mesh, got a string".
  [[noreturn]] void refuse(int number, const std::string& expected) const;

  template <class... Values>
  int give(Values&&... values) const {
    (push(lua_, std::forward<Values>(values)), ...);
    return sizeof...(values);
  }

 private:
  [[noreturn]] void refuse_self() const;
  std::string display_name() const;
  std::filesystem::path path(int number) const;

  lua_State* lua_;
  const FunctionEntry& entry_;
  Session& session_;
  int count_;  // number of arguments given, without the self of a method
};

/// Pushes the Lua function of an entry. The entry must outlive the state.
void push_function(lua_State* L, const FunctionEntry& entry);
/// The entry of a function made by push_function; null for any other value.
const FunctionEntry* entry_of_function(lua_State* L, int index);

/// A number, or text with a unit, at `index`. Throws InputError naming `what`.
double quantity_at(lua_State* L, int index, Dimension dimension, std::string_view what);
/// The same within kUsualNumbers.
double usual_quantity_at(lua_State* L, int index, Dimension dimension, std::string_view what);
/// {x, y, z} of quantities at `index`, within kUsualNumbers.
Vec3 vector_at(lua_State* L, int index, Dimension dimension, std::string_view what);

}  // namespace springlod::scripting
