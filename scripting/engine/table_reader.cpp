#include "scripting/engine/table_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "scripting/engine/quantity.hpp"
#include "scripting/engine/session.hpp"
#include "scripting/engine/suggest.hpp"
#include "scripting/engine/unknown_option.hpp"

namespace springlod::scripting {

namespace {

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

}  // namespace

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
      throw UnknownOption(
          key, fmt::format("unknown option '{}'{}", key, name_hint(key, names, owner_ + " takes")));
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
  if (!range.contains(value)) refuse(name, range_text(range, parameter.dimension, value));
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

}  // namespace springlod::scripting
