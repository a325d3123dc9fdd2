#include "model/asset/asset_json.hpp"

#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"

namespace springlod::inline model {

using nlohmann::json;

std::string utf8(const std::string& text) {
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace))
      .get<std::string>();
}

tinygltf::Value gltf_value(const json& value) {
  if (value.is_object()) {
    tinygltf::Value::Object object;
    for (const auto& [key, entry] : value.items()) object.emplace(key, gltf_value(entry));
    return tinygltf::Value(std::move(object));
  }
  if (value.is_array()) {
    tinygltf::Value::Array array;
    for (const json& entry : value) array.push_back(gltf_value(entry));
    return tinygltf::Value(std::move(array));
  }
  if (value.is_string()) return tinygltf::Value(value.get<std::string>());
  if (value.is_boolean()) return tinygltf::Value(value.get<bool>());
  if (value.is_number_float()) return tinygltf::Value(value.get<double>());
  return tinygltf::Value(value.get<int>());
}

int whole_number(std::size_t count) {
  if (count > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw IoError(fmt::format("an asset cannot count up to {}; use larger cells", count));
  return static_cast<int>(count);
}

}  // namespace springlod::inline model
