#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "model/certificate.hpp"

namespace springlod::inline model {

/// What the asset's JSON says of a level's certificate (docs/asset-format.md); empty lists are left
/// out.
nlohmann::json certificate_json(const Certificate& certificate);
/// The reverse. Throws InputError naming what is missing or of a wrong type, in `owner`'s name
/// ("the certificate of level 1").
Certificate read_certificate(const nlohmann::json& object, const std::string& owner);

}  // namespace springlod::inline model
