#include "report/view/packed.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/base64.hpp"

namespace springlod::report {
namespace {

void append(std::string& bytes, std::uint32_t value, std::size_t width) {
  for (std::size_t i = 0; i < width; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFFU);
}

constexpr double kMost16 = 65535;        // largest u16
constexpr double kMostSigned16 = 32767;  // largest i16

}  // namespace

PackedWhole pack(const std::vector<std::uint32_t>& values) {
  const std::uint32_t most = values.empty() ? 0 : *std::max_element(values.begin(), values.end());
  const std::size_t width = most <= 0xFF ? 1 : most <= 0xFFFF ? 2 : 4;
  std::string bytes;
  bytes.reserve(values.size() * width);
  for (const std::uint32_t value : values) append(bytes, value, width);
  return {width == 1 ? "u8" : width == 2 ? "u16" : "u32", base64(bytes)};
}

PackedPositions pack(const std::vector<std::vector<Vec3>>& frames) {
  Box3 box;
  for (const std::vector<Vec3>& frame : frames)
    for (const Vec3& x : frame) box.extend(x);
  if (box.isEmpty()) return {};
  PackedPositions packed{box.min(), box.sizes().maxCoeff(), {}};
  const double scale = packed.size > 0 ? kMost16 / packed.size : 0;
  std::string bytes;
  for (const std::vector<Vec3>& frame : frames)
    for (const Vec3& x : frame)
      for (int axis = 0; axis < 3; ++axis)
        append(bytes, static_cast<std::uint32_t>(std::lround((x[axis] - packed.low[axis]) * scale)),
               2);
  packed.data = base64(bytes);
  return packed;
}

PackedRows pack(const Binding& rows) {
  PackedRows packed;
  packed.scale = 0;
  for (const double weight : rows.weight) packed.scale = std::max(packed.scale, std::abs(weight));
  std::vector<std::uint32_t> counts, nodes;
  std::string bytes;
  for (std::uint32_t p = 0; p < rows.point_count(); ++p) {
    std::uint32_t count = 0;
    for (std::uint32_t e = rows.start[p]; e < rows.start[p + 1]; ++e) {
      const auto weight =
          static_cast<std::int32_t>(std::lround(rows.weight[e] / packed.scale * kMostSigned16));
      if (weight == 0) continue;
      nodes.push_back(rows.node[e]);
      append(bytes, static_cast<std::uint32_t>(weight), 2);
      ++count;
    }
    counts.push_back(count);
  }
  packed.count = pack(counts);
  packed.node = pack(nodes);
  packed.weight = base64(bytes);
  return packed;
}

}  // namespace springlod::report
