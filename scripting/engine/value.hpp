#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/vec.hpp"
#include "scripting/engine/api.hpp"

struct lua_State;

namespace springlod::scripting {

/// Name of a type of value in scripts; specialized next to the type. The address of the variable
/// identifies the type.
template <class T>
inline constexpr const char* kValueName = nullptr;

/// Values are userdata that hold a std::shared_ptr<const T>: immutable and shared. The type is
/// checked by the tag, not by the metatable, so scripts cannot forge a type even with the debug
/// library.
void push_boxed(lua_State* L, std::shared_ptr<const void> value, TypeTag tag);
/// Null if the Lua value at `index` has another type.
std::shared_ptr<const void> boxed_at(lua_State* L, int index, TypeTag tag);

/// Creates the metatables of all registered types of value.
void register_types(lua_State* L, const Api& api);

/// "a Mesh", "a string", "nothing": description for messages.
std::string describe_type_at(lua_State* L, int index);

// push: pushes one C++ value as one Lua value.
void push(lua_State* L, bool value);
void push(lua_State* L, double value);
void push(lua_State* L, const std::string& value);
void push(lua_State* L, const char* value);
void push(lua_State* L, const Vec3& value);
void push(lua_State* L, const Mat3& value);
template <class T>
requires std::integral<T> &&(!std::same_as<T, bool>)void push(lua_State* L, T value);
template <class T>
void push(lua_State* L, const std::vector<T>& values);
template <class T>
requires(kValueName<T> != nullptr) void push(lua_State* L, std::shared_ptr<const T> value) {
  push_boxed(L, std::move(value), &kValueName<T>);
}

void push_integer(lua_State* L, long long value);
void begin_list(lua_State* L, std::size_t count);
void end_list_entry(lua_State* L, std::size_t number);
void begin_table(lua_State* L);
void end_field(lua_State* L, const char* name);

template <class T>
requires std::integral<T> &&(!std::same_as<T, bool>)void push(lua_State* L, T value) {
  push_integer(L, static_cast<long long>(value));
}

template <class T>
void push(lua_State* L, const std::vector<T>& values) {
  begin_list(L, values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    push(L, values[i]);
    end_list_entry(L, i + 1);
  }
}

/// table[name] = value, for the table on top.
template <class T>
void set_field(lua_State* L, const char* name, const T& value) {
  push(L, value);
  end_field(L, name);
}

/// Builds a TypeEntry whose fields are C++ functions of the value.
template <class T>
class TypeBuilder {
 public:
  TypeBuilder(std::string summary, std::function<std::string(const T&)> describe) {
    entry_.name = kValueName<T>;
    entry_.tag = &kValueName<T>;
    entry_.summary = std::move(summary);
    entry_.describe = [describe = std::move(describe)](const void* value) {
      return describe(*static_cast<const T*>(value));
    };
  }
  /// `get` returns a value of a type that `push` supports.
  template <class Get>
  TypeBuilder& field(const std::string& name, const std::string& type, const std::string& help,
                     Get get) {
    entry_.fields.push_back({{.name = name, .type = type, .help = help},
                             [get](lua_State* L, const std::shared_ptr<const void>& value) {
                               push(L, get(*static_cast<const T*>(value.get())));
                             }});
    return *this;
  }
  /// `get` returns one of the words of an enum.
  template <class Get>
  TypeBuilder& choice_field(const std::string& name, const std::string& help, Get get) {
    field(name, "one of", help, [get](const T& value) { return to_string(get(value)); });
    entry_.fields.back().parameter.choices =
        words_of<std::remove_cvref_t<std::invoke_result_t<Get, const T&>>>();
    return *this;
  }
  /// `fill` pushes exactly one Lua value.
  TypeBuilder& table_field(const std::string& name, const std::string& type,
                           const std::string& help,
                           std::function<void(lua_State*, const T&)> fill) {
    entry_.fields.push_back(
        {{.name = name, .type = type, .help = help},
         [fill = std::move(fill)](lua_State* L, const std::shared_ptr<const void>& value) {
           fill(L, *static_cast<const T*>(value.get()));
         }});
    return *this;
  }
  /// Like `table_field`, for fields that share ownership of the value.
  TypeBuilder& shared_field(const std::string& name, const std::string& type,
                            const std::string& help,
                            std::function<void(lua_State*, std::shared_ptr<const T>)> fill) {
    entry_.fields.push_back(
        {{.name = name, .type = type, .help = help},
         [fill = std::move(fill)](lua_State* L, const std::shared_ptr<const void>& value) {
           fill(L, std::static_pointer_cast<const T>(value));
         }});
    return *this;
  }
  TypeBuilder& method(FunctionEntry entry) {
    entry_.methods.push_back(std::move(entry));
    return *this;
  }
  TypeBuilder& elements(std::function<long long(const T&)> length,
                        std::function<bool(lua_State*, std::shared_ptr<const T>, long long)> get) {
    entry_.length = [length = std::move(length)](const void* value) {
      return length(*static_cast<const T*>(value));
    };
    entry_.index = [get = std::move(get)](lua_State* L, const std::shared_ptr<const void>& value,
                                          long long number) {
      return get(L, std::static_pointer_cast<const T>(value), number);
    };
    return *this;
  }
  TypeEntry build() { return std::move(entry_); }

 private:
  TypeEntry entry_;
};

}  // namespace springlod::scripting
