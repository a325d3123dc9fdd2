#include "scripting/engine/call.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "base/units.hpp"
#include "scripting/engine/script_error.hpp"
#include "scripting/engine/suggest.hpp"

namespace springlod::scripting {

namespace {

// The whole string, including zero bytes.
std::string text_at(lua_State* L, int index) {
  std::size_t size = 0;
  const char* text = lua_tolstring(L, index, &size);
  return {text, size};
}

// Description of an invalid value for messages: "\"two\"", "1.5", "a table".
std::string shown(lua_State* L, int index) {
  switch (lua_type(L, index)) {
    case LUA_TSTRING:
      return fmt::format("\"{}\"", text_at(L, index));
    case LUA_TNUMBER:
      return lua_isinteger(L, index) != 0 ? fmt::format("{}", lua_tointeger(L, index))
                                          : fmt::format("{}", lua_tonumber(L, index));
    case LUA_TBOOLEAN:
      return lua_toboolean(L, index) != 0 ? "true" : "false";
    default:
      return describe_type_at(L, index);
  }
}

std::vector<std::string> names_of(const std::vector<Parameter>& parameters) {
  std::vector<std::string> names;
  for (const Parameter& parameter : parameters) names.push_back(parameter.name);
  return names;
}

int hex_byte(const char* digits) {
  return static_cast<int>(std::strtol(std::string(digits, 2).c_str(), nullptr, 16));
}

bool is_hex_colour(const std::string& text) {
  return text.size() == 7 && text[0] == '#' &&
         text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
}

int dispatch(lua_State* L) {
  return protect(L, [L] {
    const auto* entry = static_cast<const FunctionEntry*>(lua_touserdata(L, lua_upvalueindex(1)));
    Call call(L, *entry);
    return entry->call(call);
  });
}

}  // namespace

double quantity_at(lua_State* L, int index, Dimension dimension, std::string_view what) {
  double value = 0;
  if (lua_type(L, index) == LUA_TSTRING) {
    value = parse_quantity(lua_tostring(L, index), dimension, what);
  } else if (lua_type(L, index) == LUA_TNUMBER) {
    value = lua_tonumber(L, index);
  } else {
    const std::string_view unit = si_unit(dimension);
    throw InputError(fmt::format(
        "{} must be a number{}, got {}", what,
        unit.empty() ? "" : fmt::format(" (in {}) or text with a unit", unit), shown(L, index)));
  }
  if (!std::isfinite(value))
    throw InputError(fmt::format("{} must be finite, got {}", what, value));
  return value;
}

namespace {

std::string within(const Range& range, Dimension dimension, double value) {
  return fmt::format("from {}, got {}", to_string(range, dimension),
                     format_quantity(value, dimension));
}

}  // namespace

double usual_quantity_at(lua_State* L, int index, Dimension dimension, std::string_view what) {
  const double value = quantity_at(L, index, dimension, what);
  if (!kUsualNumbers.contains(value))
    throw InputError(fmt::format("{} must be {}", what, within(kUsualNumbers, dimension, value)));
  return value;
}

Vec3 vector_at(lua_State* L, int index, Dimension dimension, std::string_view what) {
  const int table = lua_absindex(L, index);
  if (lua_type(L, table) != LUA_TTABLE || lua_rawlen(L, table) != 3)
    throw InputError(fmt::format("{} must be a list of three numbers {{x, y, z}}, got {}", what,
                                 lua_type(L, table) == LUA_TTABLE
                                     ? fmt::format("a table of {}", lua_rawlen(L, table))
                                     : shown(L, table)));
  Vec3 vector;
  for (int axis = 0; axis < 3; ++axis) {
    lua_rawgeti(L, table, axis + 1);
    vector[axis] = usual_quantity_at(L, -1, dimension, fmt::format("{}[{}]", what, axis + 1));
    lua_pop(L, 1);
  }
  return vector;
}

TableReader::TableReader(lua_State* L, int index, const std::vector<Parameter>& listed,
                         std::string owner)
    : lua_(L),
      index_(index == 0 || lua_isnoneornil(L, index) ? 0 : lua_absindex(L, index)),
      listed_(listed),
      asked_(listed.size(), false),
      owner_(std::move(owner)) {
  if (index_ == 0) return;
  if (!lua_istable(L, index_))
    throw InputError(fmt::format("{}: expected a table of options such as {{{} = ...}}, got {}",
                                 owner_, listed_.empty() ? "name" : listed_.front().name,
                                 shown(L, index_)));
  check_keys();
}

void TableReader::check_keys() {
  const std::vector<std::string> names = names_of(listed_);
  lua_pushnil(lua_);
  while (lua_next(lua_, index_) != 0) {
    lua_pop(lua_, 1);
    if (lua_type(lua_, -1) != LUA_TSTRING)
      throw InputError(fmt::format("{}: options need names, but {} has none; {} takes: {}", owner_,
                                   shown(lua_, -1), owner_, comma_list(names)));
    const std::string key = lua_tostring(lua_, -1);
    if (std::find(names.begin(), names.end(), key) == names.end())
      throw InputError(
          fmt::format("unknown option '{}'{}", key, name_hint(key, names, owner_ + " takes")));
  }
}

const Parameter& TableReader::listed(std::string_view name) {
  for (std::size_t i = 0; i < listed_.size(); ++i) {
    if (listed_[i].name != name) continue;
    asked_[i] = true;
    return listed_[i];
  }
  throw std::logic_error(
      fmt::format("{} reads '{}', which the registry does not list", owner_, name));
}

bool TableReader::get(std::string_view name) {
  const Parameter& parameter = listed(name);
  if (index_ == 0) return false;
  if (lua_getfield(lua_, index_, parameter.name.c_str()) != LUA_TNIL) return true;
  lua_pop(lua_, 1);
  return false;
}

bool TableReader::has(std::string_view name) {
  if (!get(name)) return false;
  lua_pop(lua_, 1);
  return true;
}

void TableReader::refuse(std::string_view name, const std::string& rule) {
  throw InputError(fmt::format("{}: {} must be {}", owner_, name, rule));
}

void TableReader::check_range(std::string_view name, double value) {
  const Parameter& parameter = listed(name);
  const Range range = parameter.range.value_or(kUsualNumbers);
  if (!range.contains(value)) refuse(name, within(range, parameter.dimension, value));
}

void TableReader::check_text(std::string_view name, std::string_view text) {
  const Range range = listed(name).range.value_or(kUsualText);
  if (!range.contains(static_cast<double>(text.size())))
    refuse(name, fmt::format("text of at most {} bytes, got {}", range.most, text.size()));
}

void TableReader::check_list(std::string_view name) {
  const std::size_t size = lua_rawlen(lua_, -1);
  if (size > kLongestList)
    refuse(name, fmt::format("a list of at most {} entries, got {}", kLongestList, size));
}

void TableReader::read(std::string_view name, bool& into) {
  if (!get(name)) return;
  if (!lua_isboolean(lua_, -1)) refuse(name, "true or false, got " + shown(lua_, -1));
  into = lua_toboolean(lua_, -1) != 0;
  lua_pop(lua_, 1);
}

void TableReader::read(std::string_view name, double& into) {
  if (!get(name)) return;
  into = quantity_at(lua_, -1, listed(name).dimension, fmt::format("{}: {}", owner_, name));
  check_range(name, into);
  lua_pop(lua_, 1);
}

void TableReader::read(std::string_view name, std::string& into) {
  if (!get(name)) return;
  if (lua_type(lua_, -1) != LUA_TSTRING) refuse(name, "text, got " + shown(lua_, -1));
  into = text_at(lua_, -1);
  check_text(name, into);
  lua_pop(lua_, 1);
}

void TableReader::read(std::string_view name, Vec3& into) {
  if (!get(name)) return;
  into = vector_at(lua_, -1, listed(name).dimension, fmt::format("{}: {}", owner_, name));
  for (const double component : into) check_range(name, component);
  lua_pop(lua_, 1);
}

void TableReader::read(std::string_view name, Colour& into) {
  if (!get(name)) return;
  if (lua_type(lua_, -1) == LUA_TSTRING) {
    const std::string text = lua_tostring(lua_, -1);
    if (!is_hex_colour(text))
      refuse(name, "\"#rrggbb\" or {r, g, b} of 0..1, got " + shown(lua_, -1));
    into = {static_cast<float>(hex_byte(&text[1])) / 255.0F,
            static_cast<float>(hex_byte(&text[3])) / 255.0F,
            static_cast<float>(hex_byte(&text[5])) / 255.0F};
  } else {
    const Vec3 rgb = vector_at(lua_, -1, Dimension::number, fmt::format("{}: {}", owner_, name));
    if (rgb.minCoeff() < 0 || rgb.maxCoeff() > 1) refuse(name, "{r, g, b} of 0..1 each");
    into = {static_cast<float>(rgb.x()), static_cast<float>(rgb.y()), static_cast<float>(rgb.z())};
  }
  lua_pop(lua_, 1);
}

void TableReader::read(std::string_view name, std::vector<std::string>& into) {
  if (!get(name)) return;
  if (!lua_istable(lua_, -1)) refuse(name, "a list of words, got " + shown(lua_, -1));
  check_list(name);
  into.clear();
  for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(lua_, -1)); ++i) {
    if (lua_rawgeti(lua_, -1, i) != LUA_TSTRING)
      refuse(name, fmt::format("a list of words, but entry {} is {}", i, shown(lua_, -1)));
    check_text(name, into.emplace_back(text_at(lua_, -1)));
    lua_pop(lua_, 1);
  }
  lua_pop(lua_, 1);
}

void TableReader::read(std::string_view name, std::vector<double>& into) {
  if (!get(name)) return;
  if (!lua_istable(lua_, -1)) refuse(name, "a list of numbers, got " + shown(lua_, -1));
  check_list(name);
  into.clear();
  for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(lua_, -1)); ++i) {
    lua_rawgeti(lua_, -1, i);
    into.push_back(
        quantity_at(lua_, -1, listed(name).dimension, fmt::format("{}: {}[{}]", owner_, name, i)));
    check_range(name, into.back());
    lua_pop(lua_, 1);
  }
  lua_pop(lua_, 1);
}

std::optional<long long> TableReader::whole_number(std::string_view name, double least,
                                                   double most) {
  if (!get(name)) return std::nullopt;
  // The type of the member alone limits numbers without a range, such as seeds.
  if (const auto& range = listed(name).range) {
    least = std::max(least, range->least);
    most = std::min(most, range->most);
  }
  int exact = 0;
  const lua_Integer value =
      lua_type(lua_, -1) == LUA_TNUMBER ? lua_tointegerx(lua_, -1, &exact) : 0;
  const auto real = static_cast<double>(value);
  if (exact == 0 || real < least || real > most) {
    // The message omits upper bounds beyond 2^53, which are of no practical meaning.
    const std::string rule = exact == 0    ? "a whole number"
                             : most > 9e15 ? fmt::format("a whole number, {} or more", least)
                                           : fmt::format("a whole number of {} to {}", least, most);
    refuse(name, fmt::format("{}, got {}", rule, shown(lua_, -1)));
  }
  lua_pop(lua_, 1);
  return value;
}

void TableReader::read(std::string_view name, std::vector<std::uint32_t>& into) {
  std::vector<double> numbers;
  read(name, numbers);
  if (!has(name)) return;
  into.clear();
  for (const double number : numbers) {
    if (!(number >= 0 && number <= std::numeric_limits<std::uint32_t>::max() &&
          number == std::floor(number)))
      refuse(name, fmt::format("a list of whole numbers, got {}", number));
    into.push_back(static_cast<std::uint32_t>(number));
  }
}

void TableReader::read(std::string_view name, std::filesystem::path& into) {
  std::string text = into.string();
  read(name, text);
  if (has(name)) session_of(lua_).files().require_writable(text);
  into = text;
}

void TableReader::check_words(std::string_view name, const std::vector<std::string>& words) {
  if (listed(name).choices.names() != words)
    throw std::logic_error(
        fmt::format("{}: the registry lists other words for '{}'", owner_, name));
}

std::vector<std::string> TableReader::chosen_words(std::string_view name,
                                                   const std::vector<std::string>& words) {
  check_words(name, words);
  std::vector<std::string> chosen;
  read(name, chosen);
  for (const std::string& word : chosen)
    if (std::find(words.begin(), words.end(), word) == words.end())
      refuse(name, fmt::format("a list of {}; got '{}'{}", comma_list(words), word,
                               did_you_mean(word, words)));
  return chosen;
}

std::string TableReader::chosen_word(std::string_view name, const std::vector<std::string>& words) {
  check_words(name, words);
  if (!get(name)) return "";
  std::string word = lua_type(lua_, -1) == LUA_TSTRING ? lua_tostring(lua_, -1) : "";
  if (std::find(words.begin(), words.end(), word) == words.end())
    refuse(name, fmt::format("one of {}, got {}{}", comma_list(words), shown(lua_, -1),
                             did_you_mean(word, words)));
  lua_pop(lua_, 1);
  return word;
}

int TableReader::raw(std::string_view name) {
  return get(name) ? lua_gettop(lua_) : 0;
}

void TableReader::finish() const {
  for (std::size_t i = 0; i < listed_.size(); ++i)
    if (!asked_[i])
      throw std::logic_error(
          fmt::format("{} never reads '{}', which the registry lists", owner_, listed_[i].name));
}

Call::Call(lua_State* L, const FunctionEntry& entry)
    : lua_(L),
      entry_(entry),
      session_(session_of(L)),
      count_(lua_gettop(L) - (entry.owner.empty() ? 0 : 1)) {
  // Callbacks and nested tables need more than the 20 slots a C function gets by default.
  luaL_checkstack(L, 64, "a call of springlod");
  const int most = static_cast<int>(entry.arguments.size()) + (entry.options.empty() ? 0 : 1);
  if (count_ > most)
    throw InputError(fmt::format("{} takes {} argument{}, got {}; try help(\"{}\")", display_name(),
                                 most, most == 1 ? "" : "s", count_, display_name()));
  lua_settop(L, index(most));  // fills omitted arguments with nil, before a binding pushes values
}

int Call::index(int number) const {
  return number + (entry_.owner.empty() ? 0 : 1);
}
bool Call::has(int number) const {
  return !lua_isnoneornil(lua_, index(number));
}

std::string Call::display_name() const {
  return entry_.owner.empty() ? entry_.name : entry_.owner + ":" + entry_.name;
}

void Call::refuse(int number, const std::string& expected) const {
  const auto position = static_cast<std::size_t>(number) - 1;
  const std::string name =
      position < entry_.arguments.size() ? entry_.arguments[position].name : "options";
  throw InputError(fmt::format("bad argument {} ({}) of {}: expected {}, got {}", number, name,
                               display_name(), expected, shown(lua_, index(number))));
}

void Call::refuse_self() const {
  throw InputError(fmt::format("{} must be called with a colon, as in value:{}(...)",
                               display_name(), entry_.name));
}

std::string Call::text(int number) const {
  if (lua_type(lua_, index(number)) != LUA_TSTRING) refuse(number, "text");
  return text_at(lua_, index(number));
}

std::filesystem::path Call::path(int number) const {
  const std::string name = text(number);
  // The system would take the part before it.
  if (name.find('\0') != std::string::npos) throw InputError("a path must not have a zero byte");
  return name;
}

std::filesystem::path Call::readable(int number) const {
  std::filesystem::path path = this->path(number);
  session_.files().require_readable(path);
  return path;
}

std::filesystem::path Call::writable(int number) const {
  std::filesystem::path path = this->path(number);
  session_.files().require_writable(path);
  return path;
}

long long Call::integer(int number, long long least, long long most) const {
  int exact = 0;
  const lua_Integer value = lua_type(lua_, index(number)) == LUA_TNUMBER
                                ? lua_tointegerx(lua_, index(number), &exact)
                                : 0;
  if (exact == 0 || value < least || value > most)
    refuse(number, fmt::format("a whole number of {} to {}", least, most));
  return value;
}

TableReader Call::options(int number) const {
  return {lua_, has(number) ? index(number) : 0, entry_.options, display_name()};
}

TableReader Call::record(int index, std::string_view record, std::string owner) const {
  return {lua_, index, session_.api().record(record).fields, std::move(owner)};
}

void push_function(lua_State* L, const FunctionEntry& entry) {
  lua_pushlightuserdata(L, const_cast<FunctionEntry*>(&entry));
  lua_pushcclosure(L, dispatch, 1);
}

const FunctionEntry* entry_of_function(lua_State* L, int index) {
  if (lua_tocfunction(L, index) != dispatch) return nullptr;
  const char* name = lua_getupvalue(L, index, 1);
  if (name == nullptr) return nullptr;
  const auto* entry = static_cast<const FunctionEntry*>(lua_touserdata(L, -1));
  lua_pop(L, 1);
  return entry;
}

}  // namespace springlod::scripting
