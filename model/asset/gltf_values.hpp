#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "model/material.hpp"
#include "model/vec.hpp"

namespace springlod::inline model::gltf {

// Numbers of the glTF 2.0 specification.
enum class Target { none = 0, vertices = 34962, indices = 34963 };
enum class Component {
  unsigned_byte = 5121,
  unsigned_short = 5123,
  unsigned_int = 5125,
  single = 5126
};
enum class Mode { points = 0, lines = 1, triangles = 4 };

/// How an accessor describes elements of type T: numbers, or arrays of them.
template <class T>
struct Element;
template <>
struct Element<std::uint8_t> {
  static constexpr Component component = Component::unsigned_byte;
  static constexpr const char* type = "SCALAR";
};
template <>
struct Element<std::uint16_t> {
  static constexpr Component component = Component::unsigned_short;
  static constexpr const char* type = "SCALAR";
};
template <>
struct Element<float> {
  static constexpr Component component = Component::single;
  static constexpr const char* type = "SCALAR";
};
template <class T, std::size_t N>
struct Element<std::array<T, N>> {
  static_assert(N == 3 || N == 4 || N == 16);
  static constexpr Component component = Element<T>::component;
  static constexpr const char* type = N == 3 ? "VEC3" : N == 4 ? "VEC4" : "MAT4";
};

constexpr std::size_t bytes_of(Component component) {
  return component == Component::unsigned_byte ? 1 : component == Component::unsigned_short ? 2 : 4;
}

}  // namespace springlod::inline model::gltf

namespace springlod::inline model {

/// The sRGB transfer function: colours here are display values, glTF needs linear ones.
double linear_component(float srgb);

std::vector<std::array<float, 3>> single_precision(const std::vector<Vec3>& points);

/// A glTF material of this display colour, dull as rubber or wood.
nlohmann::json gltf_material(const std::string& name, const Colour& colour);

/// A glTF node that turns z up to glTF's y up.
nlohmann::json z_up_node();

}  // namespace springlod::inline model
