#pragma once

// What the parts of the asset's writer share.

#include <cstddef>
#include <string>

#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

namespace springlod::inline model {

/// Mesh files may hold names in any encoding, JSON only UTF-8: bytes that are none become U+FFFD.
std::string utf8(const std::string& text);

/// tinygltf has a JSON type of its own. Whole numbers must be such that `whole_number` passes.
tinygltf::Value gltf_value(const nlohmann::json& value);

/// tinygltf writes no integers above those of int. Throws IoError for more.
int whole_number(std::size_t count);

}  // namespace springlod::inline model
