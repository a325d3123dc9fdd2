#include "model/asset/gltf_values.hpp"

#include <cmath>

namespace springlod::inline model {

double linear_component(float srgb) {
  return srgb <= 0.04045F ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

std::vector<std::array<float, 3>> single_precision(const std::vector<Vec3>& points) {
  std::vector<std::array<float, 3>> floats;
  floats.reserve(points.size());
  for (const Vec3& p : points) {
    const Eigen::Vector3f f = p.cast<float>();
    floats.push_back({f.x(), f.y(), f.z()});
  }
  return floats;
}

nlohmann::json gltf_material(const std::string& name, const Colour& colour) {
  const nlohmann::json shading{
      {"baseColorFactor",
       {linear_component(colour.r), linear_component(colour.g), linear_component(colour.b), 1.0}},
      {"metallicFactor", 0.0},
      {"roughnessFactor", 0.8}};
  return {{"name", name}, {"doubleSided", true}, {"pbrMetallicRoughness", shading}};
}

nlohmann::json z_up_node() {
  // A quarter turn about x, (x, y, z) -> (x, z, -y), as quaternion x, y, z, w.
  return {{"name", "z up"}, {"rotation", {-std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)}}};
}

}  // namespace springlod::inline model
