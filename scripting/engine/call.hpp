#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "scripting/engine/session.hpp"
#include "scripting/engine/table_reader.hpp"
#include "scripting/engine/value.hpp"

struct lua_State;

namespace springlod::scripting {

/// The arguments of one call of an API function, checked against its registry entry.
class Call {
 public:
  Call(lua_State* L, const FunctionEntry& entry);

  lua_State* lua() const { return lua_; }
  Session& session() const { return session_; }
  Progress* progress() const { return session_.progress(); }

  bool has(int number) const;
  /// Whether the script gives argument `number`, be it nil.
  bool gives(int number) const { return number <= count_; }
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

}  // namespace springlod::scripting
