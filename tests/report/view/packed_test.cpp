#include "report/view/packed.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "base/base64.hpp"

using namespace springlod;
using namespace springlod::report;

namespace {

// Little-endian bytes as base64.
std::string bytes(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) text += static_cast<char>(value);
  return base64(text);
}

}  // namespace

TEST_CASE("whole numbers take as many bytes as the largest needs") {
  CHECK(pack(std::vector<std::uint32_t>{1, 255}).type == "u8");
  CHECK(pack(std::vector<std::uint32_t>{1, 255}).data == bytes({1, 255}));
  CHECK(pack(std::vector<std::uint32_t>{1, 256}).type == "u16");
  CHECK(pack(std::vector<std::uint32_t>{1, 256}).data == bytes({1, 0, 0, 1}));
  CHECK(pack(std::vector<std::uint32_t>{65536}).type == "u32");
  CHECK(pack(std::vector<std::uint32_t>{65536}).data == bytes({0, 0, 1, 0}));
  CHECK(pack(std::vector<std::uint32_t>{}).data.empty());
}

TEST_CASE("positions are spread over 16 bits of the longest edge of their box") {
  const PackedPositions packed = pack(std::vector<std::vector<Vec3>>{
      {Vec3(1, 2, 3), Vec3(5, 2, 3)}, {Vec3(1, 4, 3), Vec3(1, 2, 4)}});
  CHECK(packed.low == Vec3(1, 2, 3));
  CHECK(packed.size == 4);
  CHECK(packed.data == bytes({0, 0, 0, 0,   0, 0, 255, 255, 0, 0, 0, 0,  // first frame
                              0, 0, 0, 128, 0, 0, 0,   0,   0, 0, 0, 64}));
  // A body that is a point has no size.
  CHECK(pack(std::vector<std::vector<Vec3>>{{Vec3(1, 2, 3)}}).size == 0);
  CHECK(pack(std::vector<std::vector<Vec3>>{}).data.empty());
}

TEST_CASE("rows keep the weights that do not round to 0") {
  const Binding rows{{0, 2, 4}, {7, 300, 1, 2}, {2, -1, 1 - 1e-7, 1e-7}};
  const PackedRows packed = pack(rows);
  CHECK(packed.scale == 2);
  CHECK(packed.count.data == bytes({2, 1}));
  CHECK(packed.node.type == "u16");
  CHECK(packed.node.data == bytes({7, 0, 44, 1, 1, 0}));
  CHECK(packed.weight == bytes({255, 127, 0, 192, 255, 63}));
}
