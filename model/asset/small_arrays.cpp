#include "model/asset/small_arrays.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "model/asset/slim_asset.hpp"

namespace springlod::inline model {
namespace {

// More values than these have no table: their numbers would not fit into 8 bits.
constexpr std::size_t kLargestTable = 255;
// What the JSON says of a table [bytes].
constexpr std::size_t kTableCost = 100;

}  // namespace

template <class T>
nlohmann::json SmallArrays::add_as(const char* type, const std::uint32_t* values, std::size_t count,
                                   gltf::Target target) {
  std::vector<T> small;
  small.reserve(count);
  for (std::size_t i = 0; i < count; ++i) small.push_back(static_cast<T>(values[i]));
  return {{"view", buffer_.add(small, target)}, {"type", type}};
}

nlohmann::json SmallArrays::vectors(const std::vector<Vec3>& values, gltf::Target target) {
  std::vector<std::array<float, 3>> floats;
  floats.reserve(values.size());
  for (const Vec3& v : values)
    floats.push_back(
        {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())});
  return {{"view", buffer_.add(floats, target)}, {"type", "float32"}};
}

nlohmann::json SmallArrays::numbers(const std::vector<double>& values) {
  const std::vector<float> floats(values.begin(), values.end());
  std::vector<float> table = floats;
  std::sort(table.begin(), table.end());
  table.erase(std::unique(table.begin(), table.end()), table.end());
  if (table.size() > kLargestTable ||
      kTableCost + table.size() * sizeof(float) + floats.size() > floats.size() * sizeof(float))
    return {{"view", buffer_.add(floats)}, {"type", "float32"}};
  std::vector<std::uint8_t> number;
  number.reserve(floats.size());
  for (const float value : floats)
    number.push_back(static_cast<std::uint8_t>(std::lower_bound(table.begin(), table.end(), value) -
                                               table.begin()));
  nlohmann::json place{{"view", buffer_.add(number)}, {"type", "uint8"}};
  place["table"] = buffer_.add(table);
  return place;
}

nlohmann::json SmallArrays::weights(const std::vector<double>& values) {
  const double unit = weight_unit(values);
  std::vector<std::int16_t> multiples;
  multiples.reserve(values.size());
  for (const double value : values)
    multiples.push_back(static_cast<std::int16_t>(std::lround(value / unit)));
  return {{"view", buffer_.add(multiples)}, {"type", "int16"}, {"scale", unit}};
}

nlohmann::json SmallArrays::integers(const std::uint32_t* values, std::size_t count,
                                     gltf::Target target) {
  const std::uint32_t largest = *std::max_element(values, values + count);
  if (largest < std::numeric_limits<std::uint8_t>::max())
    return add_as<std::uint8_t>("uint8", values, count, target);
  if (largest < std::numeric_limits<std::uint16_t>::max())
    return add_as<std::uint16_t>("uint16", values, count, target);
  return add_as<std::uint32_t>("uint32", values, count, target);
}

}  // namespace springlod::inline model
