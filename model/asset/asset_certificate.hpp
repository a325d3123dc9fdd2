#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "model/certificate.hpp"

namespace springlod::inline model {

/// JSON of a level's certificate (docs/asset-format.md). Empty lists are omitted.
nlohmann::json certificate_json(const Certificate& certificate);
/// Parses that JSON. Throws InputError for a missing value or one of a wrong type; messages start
/// with `owner` ("the certificate of level 1").
Certificate read_certificate(const nlohmann::json& object, const std::string& owner);

}  // namespace springlod::inline model
