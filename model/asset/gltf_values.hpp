#pragma once

#include <array>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "model/material.hpp"
#include "model/vec.hpp"

namespace springlod::inline model {

/// The sRGB transfer function: colours here are display values, glTF needs linear ones.
double linear_component(float srgb);

std::vector<std::array<float, 3>> single_precision(const std::vector<Vec3>& points);

/// A glTF material of this display colour, dull as rubber or wood.
nlohmann::json gltf_material(const std::string& name, const Colour& colour);

}  // namespace springlod::inline model
