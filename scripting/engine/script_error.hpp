#pragma once

#include <memory>
#include <optional>
#include <string>

#include "scripting/engine/value.hpp"

namespace springlod::scripting {

/// What a failed call of the API leaves as the error value: prints as "script.lua:12: message",
/// and a script that catches it can look at its parts.
struct ErrorValue {
  std::string message;
  std::string where;  ///< "script.lua:12: " or ""
  /// "input", "io", "unstable", "tunnelled", "interrupted", "memory", "internal"
  std::string kind;
  std::optional<long long> node;        ///< where a run failed, counted from 1
  std::optional<double> time;           ///< when a run failed [s]
  std::optional<std::string> obstacle;  ///< that a node went through
};
template <>
inline constexpr const char* kValueName<ErrorValue> = "Error";

/// Describes the type Error.
void describe_errors(Api& api);

/// Turns the C++ exception that is being handled into an ErrorValue.
std::shared_ptr<const ErrorValue> current_error(lua_State* L);

/// Raises `error` in Lua; does not return.
[[noreturn]] void raise(lua_State* L, std::shared_ptr<const ErrorValue> error);

/// Runs a binding: no C++ exception leaves it, all become Lua errors. Lua's own errors, which are
/// C++ exceptions of another type, pass through untouched.
template <class Work>
int protect(lua_State* L, Work&& work) {
  std::shared_ptr<const ErrorValue> error;
  try {
    return work();
  } catch (const std::exception&) {
    error = current_error(L);
  }
  raise(L, std::move(error));
}

/// Raised by Ctrl-C between two Lua instructions.
[[noreturn]] void raise_interrupted(lua_State* L);

}  // namespace springlod::scripting
