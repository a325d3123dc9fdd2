#pragma once

#include <cstddef>
#include <cstdint>

#include "scripting/engine/api.hpp"
#include "scripting/engine/interrupt.hpp"
#include "scripting/engine/state.hpp"
#include "tests/fuzz/value_maker.hpp"

namespace springlod::fuzz {

/// A Lua state with small values of the API's types, for all inputs of a fuzz target. Calls that
/// take long get Ctrl-C.
class ApiSession {
 public:
  ApiSession();

  lua_State* lua() { return state_.lua(); }
  const scripting::Api& api() const { return state_.api(); }

  /// Calls a function of the API with arguments made from the choices. Its results are discarded.
  void call(const scripting::FunctionEntry& function, Choices& choices);
  /// The same, with a value of the global table `values` in front: the self of a method.
  void call_method(const scripting::FunctionEntry& method, Choices& choices);
  /// Calls the global Lua function `use` with the results of a function of the API, if it has not
  /// failed.
  void call_and_use(const scripting::FunctionEntry& function, Choices& choices, const char* use);

 private:
  void push_arguments(const scripting::FunctionEntry& function, Choices& choices);
  /// Calls the function below its arguments; false, and nothing on the stack, if it fails. Ends the
  /// program if it fails with an error that is no clear refusal.
  bool protected_call(int arguments, int results);

  scripting::InterruptHandler interrupts_;
  scripting::ScriptState state_;
};

}  // namespace springlod::fuzz
