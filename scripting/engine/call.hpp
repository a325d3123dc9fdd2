#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
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

/// Reads a table of options against the list in the registry. A key that is not listed is the
/// script's error; an option that is read but not listed, or listed but never read, is ours
/// (std::logic_error): so the documentation cannot lie.
class TableReader {
 public:
  /// `index` 0 or nil there: an empty table. `owner` is what messages call it ("simplify").
  TableReader(lua_State* L, int index, const std::vector<Parameter>& listed, std::string owner);

  bool has(std::string_view name);
  // Each leaves `into` alone if the option is not given.
  void read(std::string_view name, bool& into);
  void read(std::string_view name, double& into);  ///< number or "5 mm" by the listed dimension
  void read(std::string_view name, float& into);
  void read(std::string_view name, std::string& into);
  void read(std::string_view name, Vec3& into);
  void read(std::string_view name, Colour& into);
  void read(std::string_view name, std::vector<std::string>& into);
  void read(std::string_view name, std::vector<double>& into);  ///< each as a single one is read
  void read(std::string_view name, std::vector<std::uint32_t>& into);
  void read(std::string_view name, std::filesystem::path& into);
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
  /// One of the words of the enum.
  template <HasChoices E>
  void read(std::string_view name, E& into) {
    choose(name, into, choices(into));
  }
  /// A list of them.
  template <HasChoices E>
  void read(std::string_view name, std::vector<E>& into) {
    if (!has(name)) return;
    into.clear();
    for (const std::string& word : chosen_words(name, words_of<E>().names()))
      into.push_back(*from_string<E>(word));
  }
  /// One of the words of `table`, for values that are no enum.
  template <class Value, class Row>
  void choose(std::string_view name, Value& into, const ChoiceTable<Row>& table) {
    const std::string word = chosen_word(name, words_of(table).names());
    for (const Row& row : table.rows)
      if (word == row.name) into = row.value;
  }
  /// Leaves the value itself on the stack and returns its index; 0 and nothing if not given.
  int raw(std::string_view name);

  /// Throws std::logic_error if a listed option has never been asked for.
  void finish() const;

  /// "simplify: levels must be ...", as an InputError.
  [[noreturn]] void refuse(std::string_view name, const std::string& rule);
  const std::string& owner() const { return owner_; }
  lua_State* lua() const { return lua_; }

 private:
  const Parameter& listed(std::string_view name);
  bool get(std::string_view name);  // pushes the value if it is given
  std::optional<long long> whole_number(std::string_view name, double least, double most);
  /// Empty if it is not given.
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

/// One call of a function of the API: its arguments, checked against its entry in the registry.
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
  std::filesystem::path path(int number) const { return text(number); }
  double number(int number) const;
  /// A whole number of least..most.
  long long integer(int number, long long least, long long most) const;
  /// The table of options, which is argument `number` (may be left out).
  TableReader options(int number) const;
  /// A table with the keys of a record of the registry.
  TableReader record(int index, std::string_view record, std::string owner) const;

  /// "bad argument 1 (mesh) of voxelize: expected a Mesh, got a string", as an InputError.
  [[noreturn]] void refuse(int number, const std::string& expected) const;

  template <class... Values>
  int give(Values&&... values) const {
    (push(lua_, std::forward<Values>(values)), ...);
    return sizeof...(values);
  }

 private:
  [[noreturn]] void refuse_self() const;
  std::string display_name() const;

  lua_State* lua_;
  const FunctionEntry& entry_;
  Session& session_;
  int count_;  // of arguments given, the self of a method not counted
};

/// Pushes the Lua function of an entry. The entry must outlive the state.
void push_function(lua_State* L, const FunctionEntry& entry);
/// The entry of a function made by push_function; null for any other thing.
const FunctionEntry* entry_of_function(lua_State* L, int index);

/// A number, or text with a unit, at `index`. Throws InputError naming `what`.
double quantity_at(lua_State* L, int index, Dimension dimension, std::string_view what);
/// {x, y, z} of quantities at `index`.
Vec3 vector_at(lua_State* L, int index, Dimension dimension, std::string_view what);

}  // namespace springlod::scripting
