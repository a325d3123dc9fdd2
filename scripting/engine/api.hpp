#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/choice.hpp"
#include "base/range.hpp"
#include "base/units.hpp"

struct lua_State;

namespace springlod::scripting {

class Call;

/// Identity of a type of value: see kValueName in value.hpp.
using TypeTag = const char* const*;

/// The words that a parameter takes: a table of base/choice.hpp without its values.
struct Words {
  struct Word {
    std::string name{};
    std::string help{};  ///< empty if the name is self-explanatory
    /// Further properties that scripts can read, such as {"implicit", true}.
    std::vector<std::pair<std::string, bool>> traits{};
  };
  std::string name{};  ///< of the table, such as "border" for s.choices.border
  std::vector<Word> all{};

  bool empty() const { return all.empty(); }
  std::vector<std::string> names() const;
};

/// Converts a table of choices. If `choice_traits(row)` exists (found by argument-dependent
/// lookup), it returns the further properties of a row.
template <class Row>
Words words_of(const ChoiceTable<Row>& table) {
  Words words{table.name};
  for (const Row& row : table.rows) {
    Words::Word& word = words.all.emplace_back(Words::Word{row.name, row.help});
    if constexpr (requires { choice_traits(row); })
      for (const auto& [name, holds] : choice_traits(row)) word.traits.emplace_back(name, holds);
  }
  return words;
}
template <HasChoices E>
Words words_of() {
  return words_of(choices(E{}));
}

/// Of numbers without a range of their own: products of three of them stay finite.
inline constexpr Range kUsualNumbers{-1e15, 1e15};
/// Of text without a range of its own [bytes]: the longest path of Linux.
inline constexpr Range kUsualText{0, 4096};
/// Entries of a list of words or numbers.
inline constexpr std::size_t kLongestList = 100'000;

// `{}` throughout: descriptions use designated initializers and omit fields that do not apply.

/// An argument or option of a function, or a field of a value.
struct Parameter {
  std::string name{};
  std::string type{};  ///< "Mesh", "integer", "quantity", "list of Obstacle", "Material", ...
  Dimension dimension = Dimension::number;  ///< of a "quantity": sets the valid units
  std::optional<Range> range{};             ///< empty: kUsualNumbers, kUsualText
  std::string fallback{};                   ///< default as text; empty: required
  std::string help{};
  Words choices{};  ///< the allowed words; empty: any value
};

/// A function of the module, or a method of a value. `call` is its C++ implementation.
struct FunctionEntry {
  std::string name{};   ///< "voxelize"; methods: "node"
  std::string group{};  ///< heading under which help() lists it
  std::string summary{};
  std::vector<Parameter> arguments{};  ///< by position, without the self of a method
  std::vector<Parameter> options{};    ///< keys of the table that is the last argument
  std::string returns{};
  std::string errors{};
  std::string example{};
  std::function<int(Call&)> call{};
  std::string owner{};  ///< type of a method; empty for functions of the module
};

/// A read-only field, computed when a script reads it. `push` pushes exactly one Lua value.
struct FieldEntry {
  Parameter parameter{};
  std::function<void(lua_State*, const std::shared_ptr<const void>& value)> push{};
};

/// A type of value: its fields, methods and text form.
struct TypeEntry {
  std::string name{};
  TypeTag tag = nullptr;
  std::string summary{};
  std::vector<FieldEntry> fields{};
  std::deque<FunctionEntry> methods{};
  std::function<std::string(const void* value)> describe{};
  /// `value[n]` and `#value`; null if the type has neither. `index` returns false if there is no
  /// such element.
  std::function<bool(lua_State*, const std::shared_ptr<const void>&, long long)> index{};
  std::function<long long(const void*)> length{};
};

/// A plain table with known keys, such as a Material.
struct RecordEntry {
  std::string name{};
  std::string summary{};
  std::vector<Parameter> fields{};
  std::string example{};
};

/// Constants of the module: version, seed, threads ...
struct ConstantEntry {
  Parameter parameter{};
  std::function<void(lua_State*)> push{};
};

/// The registry of everything that scripts can use. The module table, help(), completion at the
/// prompt, the check of option names and docs/api.md are generated from it. Entries have stable
/// addresses, because Lua holds pointers to them.
class Api {
 public:
  FunctionEntry& add(FunctionEntry entry);
  TypeEntry& add(TypeEntry entry);
  RecordEntry& add(RecordEntry entry);
  void add(ConstantEntry entry);

  const std::deque<FunctionEntry>& functions() const { return functions_; }
  const std::deque<TypeEntry>& types() const { return types_; }
  const std::deque<RecordEntry>& records() const { return records_; }
  const std::deque<ConstantEntry>& constants() const { return constants_; }

  const FunctionEntry* find_function(std::string_view name) const;
  const TypeEntry* find_type(std::string_view name) const;
  /// Throws std::logic_error if no such record is registered (an inconsistent binding).
  const RecordEntry& record(std::string_view name) const;

  /// Every table of words that a registered parameter takes, by name.
  std::map<std::string, Words> choices() const;

 private:
  std::deque<FunctionEntry> functions_;
  std::deque<TypeEntry> types_;
  std::deque<RecordEntry> records_;
  std::deque<ConstantEntry> constants_;
};

/// Defects of the descriptions (no summary, a parameter without help ...), one
/// line each; empty if the documentation is complete.
std::vector<std::string> undocumented(const Api& api);

}  // namespace springlod::scripting
