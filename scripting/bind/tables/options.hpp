#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "base/choice.hpp"
#include "base/option.hpp"
#include "model/anchors.hpp"
#include "model/mass_spring.hpp"
#include "scripting/bind/tables/anchor_table.hpp"
#include "scripting/bind/tables/node_choice.hpp"
#include "scripting/engine/api.hpp"
#include "scripting/engine/call.hpp"

// Connects options structs with scripts: the rows of base/option.hpp define both the help and the
// keys of the table.

namespace springlod::scripting {

namespace option_detail {

template <class T>
struct ListOf : std::false_type {};
template <class T>
struct ListOf<std::vector<T>> : std::true_type {
  using Element = T;
};
template <class T>
struct OptionalOf : std::false_type {};
template <class T>
struct OptionalOf<std::optional<T>> : std::true_type {
  using Element = T;
};

template <class T>
std::string type_of(Dimension dimension) {
  if constexpr (OptionalOf<T>::value) return type_of<typename OptionalOf<T>::Element>(dimension);
  if constexpr (HasChoices<T>) return "one of";
  if constexpr (std::is_same_v<T, bool>) return "boolean";
  if constexpr (std::is_integral_v<T>) return "integer";
  if constexpr (std::is_floating_point_v<T>)
    return dimension == Dimension::number ? "number" : "quantity";
  if constexpr (ListOf<T>::value) {
    using Element = typename ListOf<T>::Element;
    if constexpr (HasChoices<Element>) return "list of";
    if constexpr (std::is_integral_v<Element>) return "list of integers";
    if constexpr (std::is_floating_point_v<Element>)
      return dimension == Dimension::number ? "list of numbers" : "list of quantities";
  }
  return "string";
}

template <class T>
std::string text_of(const T& value) {
  if constexpr (HasChoices<T>)
    return fmt::format("\"{}\"", to_string(value));
  else if constexpr (std::is_same_v<T, std::vector<double>>)
    return fmt::format("{{{:g}}}", fmt::join(value, ", "));
  else if constexpr (std::is_arithmetic_v<T>)
    return fmt::format("{}", value);
  else
    return "none";
}

template <class T>
Words choices_of() {
  if constexpr (HasChoices<T>)
    return words_of<T>();
  else if constexpr (OptionalOf<T>::value)
    return choices_of<typename OptionalOf<T>::Element>();
  else if constexpr (ListOf<T>::value)
    return choices_of<typename ListOf<T>::Element>();
  else
    return {};
}

template <class S, class Member>
Parameter parameter_of(const Option<S, Member>& row, const Member& usual) {
  return {.name = row.name,
          .type = type_of<Member>(row.dimension),
          .dimension = row.dimension,
          .range = row.range,
          .fallback = *row.fallback != '\0' ? row.fallback : text_of(usual),
          .help = row.help,
          .choices = choices_of<Member>()};
}

template <class S>
Parameter parameter_of(const NodesOption<S>& row, const std::vector<std::uint32_t>& /*usual*/) {
  return {.name = row.name,
          .type = "list of integers or function",
          .fallback = row.fallback,
          .help = row.help};
}

template <class S>
Parameter parameter_of(const SupportOption<S>& row, const Support& /*usual*/) {
  return {.name = row.name, .type = kAnchoredType, .fallback = row.fallback, .help = row.help};
}

template <class S, class Member>
Parameter parameter_of(const RecordOption<S, Member>& row, const Member& /*usual*/) {
  return {.name = row.name,
          .type = ListOf<Member>::value ? std::string("list of ") + row.record : row.record,
          .fallback = row.fallback,
          .help = row.help};
}

}  // namespace option_detail

/// The options of a function, or the fields of a record, for a struct whose defaults are `usual`.
template <HasOptions S>
std::vector<Parameter> parameters_of(const S& usual = {}) {
  std::vector<Parameter> parameters;
  for_each_option(usual, [&](const auto& row, const auto& member) {
    parameters.push_back(option_detail::parameter_of(row, member));
  });
  return parameters;
}

/// Sets the members that the script's table gives. `base`: the model that rows of
/// nodes refer to. `except`: a row that the caller reads itself.
template <HasOptions S>
void read_options(const Call& call, TableReader& reader, S& into,
                  const MassSpringModel* base = nullptr, std::string_view except = {});

namespace option_detail {

template <class S, class Member>
void read_row(const Call& /*call*/, TableReader& reader, const Option<S, Member>& row, Member& into,
              const MassSpringModel* /*base*/) {
  reader.read(row.name, into);
}

template <class S>
void read_row(const Call& /*call*/, TableReader& reader, const NodesOption<S>& row,
              std::vector<std::uint32_t>& into, const MassSpringModel* base) {
  into = read_nodes(reader, row.name, *base);
  if (*row.fallback == '\0' && into.empty())
    reader.refuse(row.name, "given: a list of node numbers or a function of a node");
}

template <class S>
void read_row(const Call& call, TableReader& reader, const SupportOption<S>& /*row*/, Support& into,
              const MassSpringModel* base) {
  into = read_anchored(call, reader, *base);
}

/// Length of the list of records at `index`; throws InputError for other values.
int list_length(TableReader& reader, const char* name, const char* record, int index);
/// Pushes an element and returns its stack index.
int push_element(lua_State* L, int list, int number);
/// Pops the values at `index` and above.
void pop_from(lua_State* L, int index);

template <class S, class Member>
void read_row(const Call& call, TableReader& reader, const RecordOption<S, Member>& row,
              Member& into, const MassSpringModel* base) {
  lua_State* L = call.lua();
  const std::string owner = reader.owner() + ": " + row.name;
  const auto read_record = [&](int table, const std::string& what, auto& record) {
    TableReader fields = call.record(table, row.record, what);
    read_options(call, fields, record, base);
    fields.finish();
  };
  const int given = reader.raw(row.name);
  if (given == 0) return;
  if constexpr (ListOf<Member>::value) {
    into.clear();
    const int length = list_length(reader, row.name, row.record, given);
    for (int i = 1; i <= length; ++i) {
      const int table = push_element(L, given, i);
      read_record(table, fmt::format("{}[{}]", owner, i), into.emplace_back());
      pop_from(L, table);
    }
  } else {
    read_record(given, owner, into);
  }
  pop_from(L, given);
}

}  // namespace option_detail

template <HasOptions S>
void read_options(const Call& call, TableReader& reader, S& into, const MassSpringModel* base,
                  std::string_view except) {
  for_each_option(into, [&](const auto& row, auto& member) {
    if (row.name != except) option_detail::read_row(call, reader, row, member, base);
  });
}

/// The parameter of that name, for additions to its description. Throws std::logic_error if there
/// is none.
Parameter& find_parameter(std::vector<Parameter>& parameters, std::string_view name);

/// Sets the defaults of `seed` and `threads` to those of the session: "s.seed".
void use_session_defaults(std::vector<Parameter>& parameters);

/// parameters_of with the session's defaults.
template <HasOptions S>
std::vector<Parameter> session_parameters() {
  std::vector<Parameter> parameters = parameters_of<S>();
  use_session_defaults(parameters);
  return parameters;
}

}  // namespace springlod::scripting
