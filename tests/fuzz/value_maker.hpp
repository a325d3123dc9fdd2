#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "scripting/engine/api.hpp"

struct lua_State;

namespace springlod::fuzz {

/// The input of a fuzz target as a row of choices. After its end, every choice is the first.
class Choices {
 public:
  Choices(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool at_end() const { return size_ == 0; }
  /// A number below `count`, which is at most 256.
  std::size_t below(std::size_t count);
  bool one_in(std::size_t count) { return below(count) + 1 == count; }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

/// Makes Lua values from choices, mostly of the type that a parameter of the API has: of numbers
/// and texts the extreme ones, of tables those with some of the known keys.
///
/// Values of the API's types are taken from the fields of the global table `values`: values.Model.
class ValueMaker {
 public:
  ValueMaker(lua_State* L, const scripting::Api& api, Choices& choices)
      : L_(L), api_(api), choices_(choices) {}

  /// Pushes a value for the parameter.
  void push(const scripting::Parameter& parameter) { push(parameter, 0); }
  /// Pushes a table with some of the keys; those without a default are rarely left out.
  void push_table(const std::vector<scripting::Parameter>& keys) { push_table(keys, 0); }

 private:
  void push(const scripting::Parameter& parameter, int depth);
  void push_typed(std::string_view type, int depth);
  void push_table(const std::vector<scripting::Parameter>& keys, int depth);
  void push_list(std::string_view type, std::size_t count, int depth);
  void push_any();
  void push_number();
  void push_integer();
  void push_text();

  lua_State* L_;
  const scripting::Api& api_;
  Choices& choices_;
};

}  // namespace springlod::fuzz
