#pragma once

#include <cstdint>
#include <optional>
#include <tuple>
#include <type_traits>
#include <vector>

#include "base/range.hpp"
#include "base/units.hpp"

namespace springlod::inline base {

/// One row of an options struct: a member under the name that scripts use. The default is the
/// member's value in a default-constructed struct.
///
/// A struct S lists its rows in `option_rows(const S*)`, declared beside it, where
/// argument-dependent lookup finds it:
///
///   constexpr auto option_rows(const FitOptions*) {
///     return std::tuple(option("tolerance", &FitOptions::tolerance, "mean error ..."), ...);
///   }
///
/// These rows define which options scripts can set, the help, the documentation, and the
/// fingerprints that identify a stored calibration. Scripts cannot set members without a row.
template <class S, class Member>
struct Option {
  const char* name;
  Member S::*member;
  const char* help;
  Dimension dimension = Dimension::number;
  const char* fallback = "";  ///< the default in words, if the member's value does not explain it
  bool is_weight = false;     ///< a dimensionless weight, not a measured quantity
  std::optional<Range> range = {};  ///< in SI units; checked where scripts set the option

  constexpr Option in(Dimension unit) const {
    Option row = *this;
    row.dimension = unit;
    return row;
  }
  constexpr Option by_default(const char* words) const {
    Option row = *this;
    row.fallback = words;
    return row;
  }
  constexpr Option within(double least, double most) const {
    Option row = *this;
    row.range = Range{least, most};
    return row;
  }
  constexpr Option weight() const {
    Option row = *this;
    row.is_weight = true;
    return row;
  }
};

template <class S, class Member>
constexpr Option<S, Member> option(const char* name, Member S::*member, const char* help) {
  return {.name = name, .member = member, .help = help};
}

/// A list of nodes of the base: scripts name them by number or by a function of a node.
template <class S>
struct NodesOption {
  const char* name;
  std::vector<std::uint32_t> S::*member;
  const char* help;
  const char* fallback;
};

template <class S>
constexpr NodesOption<S> nodes_option(const char* name, std::vector<std::uint32_t> S::*member,
                                      const char* help, const char* fallback = "") {
  return {name, member, help, fallback};
}

/// A nested options struct, or a list of such structs. Scripts write it as a separate table,
/// documented as `record`.
template <class S, class Member>
struct RecordOption {
  const char* name;
  Member S::*member;
  const char* record;
  const char* help;
  const char* fallback;
};

template <class S, class Member>
constexpr RecordOption<S, Member> record_option(const char* name, Member S::*member,
                                                const char* record, const char* help,
                                                const char* fallback) {
  return {name, member, record, help, fallback};
}

/// A nested options struct; scripts write its rows directly in the table of the outer struct.
template <class S, class Member>
struct NestedOptions {
  Member S::*member;
};

template <class S, class Member>
constexpr NestedOptions<S, Member> nested(Member S::*member) {
  return {member};
}

template <class S>
concept HasOptions = requires {
  option_rows(static_cast<const S*>(nullptr));
};

/// Calls visit(row, member of `object`) for every row; nested structs in their place. `object` may
/// be const.
template <class S, class Visit>
requires HasOptions<std::remove_const_t<S>>
void for_each_option(S& object, Visit&& visit);

namespace option_detail {

template <class S, class Outer, class Member, class Visit>
void visit_row(S& object, const NestedOptions<Outer, Member>& row, Visit& visit) {
  for_each_option(object.*row.member, visit);
}

template <class S, class Row, class Visit>
void visit_row(S& object, const Row& row, Visit& visit) {
  visit(row, object.*row.member);
}

}  // namespace option_detail

template <class S, class Visit>
requires HasOptions<std::remove_const_t<S>>
void for_each_option(S& object, Visit&& visit) {
  std::apply([&](const auto&... row) { (option_detail::visit_row(object, row, visit), ...); },
             option_rows(static_cast<const S*>(nullptr)));
}

}  // namespace springlod::inline base
