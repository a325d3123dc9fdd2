#pragma once

#include <memory>
#include <optional>
#include <string>

#include "scripting/engine/value.hpp"

namespace springlod::scripting {

/// The Lua error value of a failed API call. It prints as "script.lua:12: message"; a script that
/// catches the error can read its fields.
struct ErrorValue {
  std::string message;
  std::string where;  ///< "script.lua:12: " or ""
  /// "input", "io", "unstable", "tunnelled", "interrupted", "memory", "internal"
  std::string kind;
  std::optional<long long> node;        ///< where a run failed, counted from 1
  std::optional<double> time;           ///< when a run failed [s]
  std::optional<std::string> obstacle;  ///< obstacle that a node passed through
};
template <>
inline constexpr const char* kValueName<ErrorValue> = "Error";

/// Describes the type Error.
void describe_errors(Api& api);

/// The innermost line of Lua that runs, "script.lua:12: "; "" if there is none.
std::string call_site(lua_State* L);

/// Converts the current C++ exception into an ErrorValue.
std::shared_ptr<const ErrorValue> current_error(lua_State* L);

/// Raises `error` in Lua; does not return.
[[noreturn]] void raise(lua_State* L, std::shared_ptr<const ErrorValue> error);

/// Runs a binding and converts its C++ exceptions into Lua errors. Lua's own errors (C++ exceptions
/// of another type) pass through unchanged.
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

/// Raises the Lua error for Ctrl-C between two Lua instructions.
[[noreturn]] void raise_interrupted(lua_State* L);

}  // namespace springlod::scripting
