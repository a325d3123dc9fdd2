#include "tests/fuzz/value_maker.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <string>

#include <lua.hpp>

namespace springlod::fuzz {
namespace {

using scripting::Parameter;

constexpr int kDeepest = 4;              // of nested tables; records may refer to themselves
constexpr std::size_t kLongestList = 4;  // entries
constexpr std::size_t kWrongValue = 16;  // one value in so many is of any type
constexpr std::size_t kMissingKey = 16;  // one required key in so many is left out
constexpr std::size_t kUsedOption = 3;   // one key with a default in so many is given

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr auto kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kNumbers[] = {1,    0,    0.5,  2,      0.1,    0.01,      1e-3, -1,
                               1e6,  1e3,  0.25, 1e-9,   1e-300, 1e300,     1e12, -0.5,
                               -0.0, kNan, 5,    -1e300, 45,     kInfinity, 100,  -kInfinity};
constexpr lua_Integer kIntegers[] = {1,
                                     0,
                                     2,
                                     3,
                                     5,
                                     8,
                                     -1,
                                     100,
                                     64,
                                     1'000'000,
                                     0x7FFFFFFF,
                                     0xFFFFFFFF,
                                     -2,
                                     0x100000000,
                                     std::numeric_limits<lua_Integer>::max(),
                                     std::numeric_limits<lua_Integer>::min()};
// No place to which a file could be written.
constexpr std::string_view kTexts[] = {"rubber",
                                       "steel",
                                       "",
                                       "1 mm",
                                       "10 MPa",
                                       "5",
                                       "floor",
                                       "nothing",
                                       "/proc/no/file.glb",
                                       "/dev/null",
                                       "1e999 m",
                                       "-1 kg/m3",
                                       "\xFF\xC0",
                                       std::string_view("a\0b", 3),
                                       "%s%n"};

template <class List>
const auto& pick(Choices& choices, const List& list) {
  return list[choices.below(std::size(list))];
}

/// "A or B": the parts.
std::vector<std::string_view> alternatives(std::string_view type) {
  std::vector<std::string_view> parts;
  for (const std::string_view separator : {std::string_view(" or "), std::string_view(", ")}) {
    const std::size_t at = type.find(separator);
    if (at == std::string_view::npos || type.starts_with("{") || type.starts_with("list of"))
      continue;
    parts = {type.substr(0, at), type.substr(at + separator.size())};
    return parts;
  }
  return parts;
}

}  // namespace

std::size_t Choices::below(std::size_t count) {
  if (size_ == 0 || count == 0) return 0;
  --size_;
  return *data_++ % count;
}

void ValueMaker::push_number() {
  lua_pushnumber(L_, pick(choices_, kNumbers));
}
void ValueMaker::push_integer() {
  lua_pushinteger(L_, pick(choices_, kIntegers));
}

void ValueMaker::push_text() {
  const std::string_view text = pick(choices_, kTexts);
  lua_pushlstring(L_, text.data(), text.size());
}

void ValueMaker::push_any() {
  switch (choices_.below(8)) {
    case 0:
      return lua_pushnil(L_);
    case 1:
      return lua_pushboolean(L_, 1);
    case 2:
      return push_number();
    case 3:
      return push_integer();
    case 4:
      return push_text();
    case 5:
      return lua_newtable(L_);
    case 6:
      return push_list("number", choices_.below(kLongestList), kDeepest);
    default: {
      const auto& type = pick(choices_, api_.types());
      return push_typed(type.name, kDeepest);
    }
  }
}

void ValueMaker::push_list(std::string_view type, std::size_t count, int depth) {
  lua_createtable(L_, static_cast<int>(count), 0);
  for (std::size_t i = 1; i <= count; ++i) {
    push({.type = std::string(type)}, depth + 1);
    lua_rawseti(L_, -2, static_cast<lua_Integer>(i));
  }
}

void ValueMaker::push_table(const std::vector<Parameter>& keys, int depth) {
  lua_newtable(L_);
  for (const Parameter& key : keys) {
    const bool given =
        key.fallback.empty() ? !choices_.one_in(kMissingKey) : choices_.one_in(kUsedOption);
    if (!given) continue;
    push(key, depth + 1);
    lua_setfield(L_, -2, key.name.c_str());
  }
}

void ValueMaker::push(const Parameter& parameter, int depth) {
  if (choices_.one_in(kWrongValue)) return push_any();
  if (parameter.choices.empty()) return push_typed(parameter.type, depth);
  const std::string& word = pick(choices_, parameter.choices.all).name;
  if (!parameter.type.starts_with("list of")) {
    lua_pushlstring(L_, word.data(), word.size());
    return;
  }
  lua_newtable(L_);
  lua_pushlstring(L_, word.data(), word.size());
  lua_rawseti(L_, -2, 1);
}

// The types are those of the descriptions: "number", "list of Obstacle", "{x, y, z} in m" ...
void ValueMaker::push_typed(std::string_view type, int depth) {
  if (depth > kDeepest) return lua_pushnil(L_);
  if (type == "number" || type.starts_with("quantity")) return push_number();
  if (type == "integer") return push_integer();
  if (type == "boolean") return lua_pushboolean(L_, choices_.one_in(2) ? 1 : 0);
  if (type == "string") return push_text();
  if (type.starts_with("list of numbers") || type.starts_with("list of quantities"))
    return push_list("number", choices_.below(kLongestList), depth);
  if (type.starts_with("list of integers"))
    return push_list("integer", choices_.below(kLongestList), depth);
  if (type.starts_with("list of ")) {
    return push_list(type.substr(std::string_view("list of ").size()), choices_.below(kLongestList),
                     depth);
  }
  if (type.starts_with("{"))
    return push_list(
        "number", static_cast<std::size_t>(1 + std::count(type.begin(), type.end(), ',')), depth);
  if (type.starts_with("table part = Material")) {
    lua_newtable(L_);
    for (const char* part : {"rubber", "steel"}) {
      push_typed("Material", depth + 1);
      lua_setfield(L_, -2, part);
    }
    return;
  }
  if (type.starts_with("function")) {
    lua_getglobal(L_, "values");
    lua_getfield(L_, -1, "functions");
    lua_rawgeti(L_, -1, static_cast<lua_Integer>(1 + choices_.below(lua_rawlen(L_, -1))));
    return lua_replace(L_, -3), lua_pop(L_, 1);
  }
  for (const scripting::RecordEntry& record : api_.records())
    if (record.name == type) return push_table(record.fields, depth);
  if (api_.find_type(type) != nullptr) {
    lua_getglobal(L_, "values");
    lua_getfield(L_, -1, std::string(type).c_str());
    return lua_remove(L_, -2);
  }
  const auto parts = alternatives(type);
  if (parts.empty()) return push_any();
  push_typed(pick(choices_, parts), depth);
}

}  // namespace springlod::fuzz
