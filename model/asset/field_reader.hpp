#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.hpp"

namespace springlod::inline model {

/// Reads the fields of a JSON object with strict types: the JSON library would convert true to 1
/// and 2.5 to 2. `owner` names the object in messages. Throws InputError for a field that is
/// missing or of another type. The object must live as long as its reader.
class FieldReader {
 public:
  FieldReader(const nlohmann::json& object, std::string owner)
      : object_(object), owner_(std::move(owner)) {
    if (!object.is_object())
      throw InputError(fmt::format("{} must be an object, not {}", owner_, object.type_name()));
  }

  bool has(const char* key) const { return object_.contains(key); }
  bool is_object(const char* key) const {
    const auto found = object_.find(key);
    return found != object_.end() && found->is_object();
  }
  bool is_empty_list(const char* key) const {
    const auto found = object_.find(key);
    return found != object_.end() && found->is_array() && found->empty();
  }
  /// Reader of the object at `key`.
  FieldReader nested(const char* key) const {
    return {field(key, &nlohmann::json::is_object, "an object"),
            fmt::format("{}, {}", owner_, key)};
  }
  double number(const char* key) const {
    return field(key, &nlohmann::json::is_number, "a number").get<double>();
  }
  std::optional<double> optional_number(const char* key) const {
    return has(key) ? std::optional(number(key)) : std::nullopt;
  }
  bool flag(const char* key) const {
    return field(key, &nlohmann::json::is_boolean, "true or false").get<bool>();
  }
  std::string text(const char* key) const {
    return field(key, &nlohmann::json::is_string, "text").get<std::string>();
  }
  std::uint32_t count(const char* key) const {
    const auto number =
        field(key, &nlohmann::json::is_number_unsigned, "a count").get<std::uint64_t>();
    if (number > std::numeric_limits<std::uint32_t>::max())
      throw InputError(fmt::format("{}: '{}' cannot be {}", owner_, key, number));
    return static_cast<std::uint32_t>(number);
  }
  /// 0 if it is missing.
  std::uint32_t optional_count(const char* key) const { return has(key) ? count(key) : 0; }
  /// Calls read(entry, name) for each entry of a list; does nothing if the list is missing.
  template <class Read>
  void each(const char* key, const Read& read) const {
    if (!has(key)) return;
    std::size_t place = 0;
    for (const nlohmann::json& entry : field(key, &nlohmann::json::is_array, "a list"))
      read(entry, fmt::format("{}, {} {}", owner_, key, ++place));
  }

 private:
  const nlohmann::json& field(const char* key, bool (nlohmann::json::*is_right)() const noexcept,
                              const char* right) const {
    const auto found = object_.find(key);
    if (found == object_.end()) throw InputError(fmt::format("{}: '{}' is missing", owner_, key));
    if (!((*found).*is_right)())
      throw InputError(
          fmt::format("{}: '{}' must be {}, not {}", owner_, key, right, found->type_name()));
    return *found;
  }

  const nlohmann::json& object_;
  std::string owner_;
};

}  // namespace springlod::inline model
