#include "model/asset/asset.hpp"

#include <cstring>
#include <fstream>
#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "base/error.hpp"
#include "base/file.hpp"
#include "model/asset/checksum.hpp"
#include "tests/model/asset/glb_text.hpp"
#include "tests/support/assets.hpp"
#include "tests/support/dilatation.hpp"
#include "tests/support/lattices.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/temporary_folder.hpp"

namespace springlod {
namespace {

using Catch::Matchers::Contains;
using test::Layout;
using test::sample_asset;
using test::TemporaryFolder;
using test::with_json;

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(static_cast<const void*>(a.data()),
                                   static_cast<const void*>(b.data()), a.size() * sizeof(T)) == 0);
}

void check_same(const LodAsset& a, const LodAsset& b) {
  REQUIRE(a.chain.levels.size() == b.chain.levels.size());
  for (std::size_t n = 0; n < a.chain.levels.size(); ++n) {
    const Level& p = a.chain.levels[n];
    const Level& q = b.chain.levels[n];
    CHECK(p.made_by == q.made_by);
    CHECK(p.of_base.count == q.of_base.count);
    CHECK(same_bits(p.of_base.of, q.of_base.of));
    CHECK(p.model.materials == q.model.materials);
    CHECK(same_bits(p.model.rest, q.model.rest));
    CHECK(same_bits(p.model.mass, q.model.mass));
    CHECK(same_bits(p.model.volume, q.model.volume));
    CHECK(same_bits(p.model.contact_area, q.model.contact_area));
    CHECK(same_bits(p.model.border, q.model.border));
    CHECK(same_bits(p.model.material, q.model.material));
    CHECK(same_bits(p.model.a, q.model.a));
    CHECK(same_bits(p.model.b, q.model.b));
    CHECK(same_bits(p.model.rest_length, q.model.rest_length));
    CHECK(same_bits(p.model.stiffness, q.model.stiffness));
    CHECK(same_bits(p.model.damping, q.model.damping));
    CHECK(p.model.corners == q.model.corners);
    CHECK(same_bits(p.model.surface.of_nodes.start, q.model.surface.of_nodes.start));
    CHECK(same_bits(p.model.surface.of_nodes.node, q.model.surface.of_nodes.node));
    CHECK(same_bits(p.model.surface.of_nodes.weight, q.model.surface.of_nodes.weight));
    CHECK(same_bits(p.model.surface.normal, q.model.surface.normal));
    CHECK(same_bits(p.model.surface.area, q.model.surface.area));
    CHECK(same_bits(p.model.surface.stiffness, q.model.surface.stiffness));
    CHECK(same_bits(p.model.dilatation.modulus, q.model.dilatation.modulus));
    CHECK(same_bits(p.model.dilatation.damping_time, q.model.dilatation.damping_time));
    CHECK(same_bits(p.model.dilatation.start, q.model.dilatation.start));
    CHECK(same_bits(p.model.dilatation.node, q.model.dilatation.node));
    CHECK(same_bits(p.model.dilatation.gradient, q.model.dilatation.gradient));
  }
  CHECK(same_bits(a.surface.positions, b.surface.positions));
  CHECK(same_bits(a.surface.triangles, b.surface.triangles));
  REQUIRE(a.surface.parts.size() == b.surface.parts.size());
  for (std::size_t p = 0; p < a.surface.parts.size(); ++p) {
    CHECK(a.surface.parts[p].name == b.surface.parts[p].name);
    CHECK(a.surface.parts[p].material == b.surface.parts[p].material);
    CHECK(a.surface.parts[p].first_triangle == b.surface.parts[p].first_triangle);
    CHECK(a.surface.parts[p].triangle_count == b.surface.parts[p].triangle_count);
  }
  CHECK(same_bits(a.surface_of_base.start, b.surface_of_base.start));
  CHECK(same_bits(a.surface_of_base.node, b.surface_of_base.node));
  CHECK(same_bits(a.surface_of_base.weight, b.surface_of_base.weight));
  CHECK(a.provenance.entries == b.provenance.entries);
}

/// Overwrites the file in place: thousands of renames would each wait for the disk.
void overwrite(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

TEST_CASE("A saved asset is restored with the same bits") {
  const TemporaryFolder folder;
  const LodAsset asset = sample_asset();
  save_asset(asset, folder / "asset.glb");
  check_same(load_asset(folder / "asset.glb"), asset);
}

TEST_CASE("An asset without surface, springs or provenance is restored with the same bits") {
  const TemporaryFolder folder;
  LodAsset asset;
  asset.chain.levels.resize(1);
  asset.chain.levels[0].model = test::make_model({{1.0 / 3, 2, 3}}, {});
  asset.chain.levels[0].of_base = identity_groups(1);
  SECTION("no binding") {}
  SECTION("a binding of no points") {
    asset.surface_of_base.start = {0};
  }
  SECTION("a surface of vertices only") {
    asset.surface.positions = {{0, 0, 0}};
    asset.surface_of_base = bind_points(asset.surface.positions, asset.chain.levels[0].model);
  }
  SECTION("a part without triangles") {
    asset.surface.parts = {{"nothing", "", 0, 0}};
  }
  save_asset(asset, folder / "asset.glb");
  check_same(load_asset(folder / "asset.glb"), asset);
}

TEST_CASE("The same asset gives the same bytes") {
  const TemporaryFolder folder;
  save_asset(sample_asset(), folder / "a.glb");
  save_asset(sample_asset(), folder / "b.glb");
  const std::string bytes = read_file(folder / "a.glb");
  CHECK(bytes == read_file(folder / "b.glb"));
  save_asset(load_asset(folder / "a.glb"), folder / "c.glb");
  CHECK(bytes == read_file(folder / "c.glb"));
}

/// sample_asset with corners on two of its levels, of one modulus and of several.
LodAsset asset_with_corners() {
  LodAsset asset = sample_asset();
  for (const std::size_t n : {std::size_t{0}, std::size_t{2}}) {
    MassSpringModel& m = asset.chain.levels[n].model;
    const std::uint32_t side = n == 0 ? 4 : 2;
    const std::uint32_t layer = side * side;
    for (std::uint32_t i = 0; i + layer + side + 1 < m.node_count(); i += layer)
      m.corners.push_back({{i, i + 1, i + side, i + layer}, n == 0 ? 1e5 / (1 + i % 3) : 1e6 / 3});
    REQUIRE(m.corners.size() > 1);
  }
  return asset;
}

TEST_CASE("Corners are restored with the same bits") {
  const TemporaryFolder folder;
  const LodAsset asset = asset_with_corners();
  save_asset(asset, folder / "asset.glb");
  check_same(load_asset(folder / "asset.glb"), asset);
}

TEST_CASE("Malformed corners are rejected") {
  const TemporaryFolder folder;
  const auto path = folder / "asset.glb";
  save_asset(asset_with_corners(), path);
  const std::string bytes = read_file(path);
  const auto refused = [&](const std::string& from, const std::string& to,
                           const std::string& reason) {
    INFO(from << " -> " << to);
    overwrite(path, with_json(bytes, from, to));
    CHECK_THROWS_AS(load_asset(path), IoError);
    CHECK_THROWS_WITH(load_asset(path), Contains("damaged") && Contains(reason));
  };
  refused("\"cornerYoung\"", "\"c\"", "a modulus that does not exist");
  refused("\"cornerYoungNumber\"", "\"c\"", "moduli of its corners");
  refused("\"cornerNodes\"", "\"c\"", "its array cornerNodes has 0 bytes");
  refused("\"cornerNodes\":", "\"cornerNodes\":0,\"c\":", "");
  refused("\"corners\":4", "\"corners\":5", "its array cornerNodes has");
}

// version_1.glb was written by version 0.1.0: four nodes, of which level 1 merges the first two.
// The others are by later programs: 27 nodes of rubber and a level of 12 nodes; 2 has a
// certificate, 3 a Poisson's ratio of 0.4, 4 and 5 (slim) a surface and contact points.
std::string old_asset(int version) {
  return read_file(test::source_folder() / "tests/golden" / fmt::format("version_{}.glb", version));
}

TEST_CASE("Assets of older versions are read, and saved in the newest") {
  const TemporaryFolder folder;
  for (int version = 1; version <= 5; ++version) {
    CAPTURE(version);
    const LodAsset asset = parse_asset(old_asset(version), "old.glb");
    REQUIRE(asset.chain.levels.size() == 2);
    const Level& base = asset.chain.levels[0];
    const Level& merged = asset.chain.levels[1];
    if (version == 1) {
      CHECK(base.model.mass == std::vector<double>{1, 2, 3, 4});
      CHECK(merged.of_base.of == std::vector<std::uint32_t>{0, 0, 1, 2});
    } else {
      CHECK(base.model.node_count() == 27);
      CHECK(merged.model.node_count() == 12);
    }
    for (const Level& level : asset.chain.levels) {
      CHECK(level.model.corners.empty() == (version == 1));
      CHECK(level.model.dilatation.empty() == (version != 3));
    }
    CHECK(merged.certificate.has_value() == (version == 2));
    CHECK(base.model.surface.empty() == (version < 4));
    CHECK(asset.surface.triangles.empty() == (version < 4));
    save_asset(asset, folder / "asset.glb");
    check_same(load_asset(folder / "asset.glb"), asset);
    CHECK_THAT(read_file(folder / "asset.glb"), Contains("\"version\":6"));
  }
}

TEST_CASE("Damaged assets of older versions are refused by their checksum") {
  for (int version = 1; version <= 5; ++version) {
    CAPTURE(version);
    const std::string bytes = old_asset(version);
    std::string flipped = bytes;
    flipped[Layout(bytes).binary_begin + 9] ^= 1;  // in the rest positions of level 0
    CHECK_THROWS_WITH(parse_asset(flipped, "old.glb"), Contains("checksum"));
    std::string renamed = bytes;
    renamed[bytes.find("\"madeBy\":\"") + 10] ^= 1;
    CHECK_THROWS_WITH(parse_asset(renamed, "old.glb"), Contains("checksum"));
  }
}

TEST_CASE("Dilatation terms and Poisson's ratio are restored with the same bits") {
  const TemporaryFolder folder;
  LodAsset asset;
  asset.chain.levels.push_back({test::lattice_with_terms(3, 3, 3), identity_groups(27), "base"});
  SECTION("terms") {}
  SECTION("a material alone") {
    asset.chain.levels[0].model.materials[0].poisson = 0.4;
    asset.chain.levels[0].model.dilatation = {};
  }
  save_asset(asset, folder / "asset.glb");
  check_same(load_asset(folder / "asset.glb"), asset);
}

/// A cube of eight nodes with two contact points.
LodAsset asset_with_surface() {
  LodAsset asset;
  asset.chain.levels.push_back({test::box_lattice(2, 2, 2), identity_groups(8), "base"});
  ContactSurface& surface = asset.chain.levels[0].model.surface;
  surface.of_nodes = {{0, 2, 4}, {0, 1, 4, 7}, {0.25, 0.75, 1.25, -0.25}};
  surface.normal = {-Vec3::UnitZ(), Vec3::UnitZ()};
  surface.area = {0.125, 1.0 / 3};
  surface.stiffness = {3, 1e5};
  return asset;
}

TEST_CASE("A contact surface is restored with the same bits") {
  const TemporaryFolder folder;
  const LodAsset asset = asset_with_surface();
  save_asset(asset, folder / "asset.glb");
  check_same(load_asset(folder / "asset.glb"), asset);
}

TEST_CASE("A damaged contact surface is refused") {
  const TemporaryFolder folder;
  const auto path = folder / "asset.glb";
  save_asset(asset_with_surface(), path);
  const std::string bytes = read_file(path);
  for (const auto& [from, to] :
       {std::pair("\"contactPoints\":2", "\"contactPoints\":3"),
        std::pair("\"contactStart\"", "\"c\""), std::pair("\"contactNormal\"", "\"c\""),
        std::pair("\"contactNode\":", "\"contactNode\":0,\"c\":")}) {
    INFO(from << " -> " << to);
    overwrite(path, with_json(bytes, from, to));
    CHECK_THROWS_AS(load_asset(path), IoError);
    CHECK_THROWS_WITH(load_asset(path), Contains("damaged"));
  }
  const auto refused = [](auto change) {
    LodAsset asset = asset_with_surface();
    change(asset.chain.levels[0].model.surface);
    CHECK_THROWS_AS(validate(asset), InputError);
  };
  refused([](ContactSurface& s) { s.area[0] = 0; });
  refused([](ContactSurface& s) { s.stiffness[1] = -1; });
  refused([](ContactSurface& s) { s.normal[1] *= 2; });
  refused([](ContactSurface& s) { s.normal.pop_back(); });
  refused([](ContactSurface& s) { s.of_nodes.node[3] = 8; });
  refused([](ContactSurface& s) { s.of_nodes.weight[3] = 0.25; });
}

TEST_CASE("Damaged dilatation terms are refused") {
  const TemporaryFolder folder;
  const auto path = folder / "asset.glb";
  LodAsset asset;
  asset.chain.levels.push_back({test::lattice_with_terms(3, 3, 3), identity_groups(27), "base"});
  save_asset(asset, path);
  const std::string bytes = read_file(path);
  for (const auto& [from, to] :
       {std::pair("\"terms\":8", "\"terms\":9"),
        std::pair("\"termNode\":", "\"termNode\":0,\"c\":"), std::pair("\"termStart\"", "\"c\""),
        std::pair("\"termModulus\"", "\"c\"")}) {
    INFO(from << " -> " << to);
    overwrite(path, with_json(bytes, from, to));
    CHECK_THROWS_AS(load_asset(path), IoError);
    CHECK_THROWS_WITH(load_asset(path), Contains("damaged"));
  }
}

TEST_CASE("Names that are not UTF-8 are saved with invalid bytes replaced") {
  const TemporaryFolder folder;
  LodAsset asset = sample_asset();
  asset.surface.parts[0].name = "gr\xFCn";
  save_asset(asset, folder / "asset.glb");
  CHECK(load_asset(folder / "asset.glb").surface.parts[0].name == "gr\xEF\xBF\xBDn");
}

TEST_CASE("An invalid asset is not saved") {
  const TemporaryFolder folder;
  LodAsset asset = sample_asset();
  asset.chain.levels[1].model.mass[3] = -1;
  CHECK_THROWS_WITH(save_asset(asset, folder / "asset.glb"),
                    Contains("level 1") && Contains("node 4"));
  CHECK_FALSE(std::filesystem::exists(folder / "asset.glb"));
}

TEST_CASE("A file that is not an asset is rejected with the reason") {
  const TemporaryFolder folder;
  const auto path = folder / "asset.glb";
  CHECK_THROWS_WITH(load_asset(folder / "missing.glb"),
                    Contains("missing.glb") && Contains("No such file"));
  CHECK_THROWS_AS(load_asset(folder.path()), IoError);
  for (const char* text : {"", "glTF", "solid thing\nendsolid, and some more text\n"}) {
    overwrite(path, text);
    CHECK_THROWS_WITH(load_asset(path), Contains("not a .glb file"));
  }
  save_asset(sample_asset(), path);
  const std::string bytes = read_file(path);
  overwrite(path, with_json(bytes, "\"extensions\":", "\"extras\":"));
  CHECK_THROWS_WITH(load_asset(path), Contains("no level-of-detail chain"));
  overwrite(path, with_json(bytes, "\"version\":6", "\"version\":7"));
  CHECK_THROWS_WITH(load_asset(path), Contains("version 7") && Contains("update"));
  overwrite(path, with_json(bytes, "by hand", "by mind"));
  CHECK_THROWS_WITH(load_asset(path), Contains("damaged") && Contains("checksum"));
  CHECK_THROWS_AS(load_asset(path), IoError);
}

TEST_CASE("A version or count that is no whole number, and deep JSON, are refused") {
  const TemporaryFolder folder;
  const auto path = folder / "asset.glb";
  save_asset(sample_asset(), path);
  const std::string bytes = read_file(path);
  for (const char* version : {"18446744073709551615", "-1", "1.9", "0", "\"2\"", "null"}) {
    CAPTURE(version);
    overwrite(path, with_json(bytes, "\"version\":6", fmt::format("\"version\":{}", version)));
    CHECK_THROWS_AS(load_asset(path), IoError);
    CHECK_THROWS_WITH(load_asset(path), Contains("damaged"));
  }
  const std::string deep = std::string(1'000'000, '[') + std::string(1'000'000, ']');
  overwrite(path, with_json(bytes, "\"version\":6", "\"version\":6,\"deep\":" + deep));
  CHECK_THROWS_WITH(load_asset(path), Contains("nested too deeply"));
  overwrite(path, with_json(bytes, "\"version\":6", "\"version\":6,\"text\":\"\\\"[[[\""));
  CHECK_THROWS_WITH(load_asset(path), Contains("checksum"));
}

TEST_CASE("A buffer view outside the file is detected") {
  const TemporaryFolder folder;
  const auto path = folder / "asset.glb";
  save_asset(sample_asset(), path);
  const std::string bytes = read_file(path);
  for (const char* length : {"18446744073709551615", "-1", "1.5", "99999999", "1920000", "0"}) {
    const std::string first = "\"byteLength\":1920";  // level 0: 80 nodes of 24 bytes
    overwrite(path, with_json(bytes, first, fmt::format("\"byteLength\":{}", length)));
    CHECK_THROWS_WITH(load_asset(path), Contains("damaged"));
  }
}

TEST_CASE("Counts that do not fit the arrays are refused before memory is allocated") {
  const TemporaryFolder folder;
  const auto path = folder / "asset.glb";
  save_asset(sample_asset(), path);
  const std::string bytes = read_file(path);
  const auto refused = [&](const std::string& from, const std::string& to,
                           const std::string& reason) {
    INFO(from << " -> " << to);
    overwrite(path, with_json(bytes, from, to));
    CHECK_THROWS_WITH(load_asset(path), Contains("damaged") && Contains(reason));
  };
  refused("\"nodes\":80", "\"nodes\":4294967295", "its array rest has 1920 bytes");
  refused("\"nodes\":80", "\"nodes\":79", "79 entries need 1896");
  refused("\"nodes\":80", "\"nodes\":true", "'nodes' must be a count");
  refused("\"springs\":", "\"springs\":9", "its array ends has");
  refused("\"vertices\":8", "\"vertices\":4294967295", "its array positions has 192 bytes");
  refused("\"triangles\":12", "\"triangles\":0", "its array indices has 144 bytes");
  refused("\"bindingWeight\":", "\"w\":", "its array bindingWeight has 0 bytes");
  refused("\"levels\":[", "\"levels\":7,\"l\":[", "'levels' must be a list");
  refused("\"mass\":{\"type\":\"float64\",\"view\":1", "\"mass\":{\"type\":\"float64\",\"view\":99",
          "its array mass refers to buffer view 99");
  refused("\"mass\":{", "\"mass\":1,\"m\":{", "its array mass must be an object");
  refused("\"width\":3", "\"width\":1", "its array rest must have 3 numbers");
  refused("\"colour\":[", "\"colour\":[,", "its JSON chunk is not valid at byte");
  refused("\"colour\":[", "\"colour\":[true,", "three numbers");
  refused("\"density\":1100.0", "\"density\":true", "materials 2: 'density' must be a number");
}

TEST_CASE("Arrays that overlap are refused: a small file could ask for much memory") {
  const TemporaryFolder folder;
  const auto path = folder / "asset.glb";
  save_asset(sample_asset(), path);
  const std::string bytes = read_file(path);
  const Layout layout(bytes);
  std::string json = bytes.substr(layout.json_begin, layout.json_end - layout.json_begin);
  const std::size_t first = json.find("\"levels\":[") + 10;
  const std::string level = json.substr(first, json.find(",{\"border\"", first) - first);
  REQUIRE(level.starts_with("{\"border\""));
  std::string levels;
  for (int i = 0; i < 100; ++i) levels += level + ",";
  overwrite(path, with_json(bytes, level, levels + level));
  CHECK_THROWS_WITH(load_asset(path), Contains("damaged") && Contains("its arrays overlap"));
}

TEST_CASE("A JSON chunk that is far too large is refused before it is parsed") {
  const TemporaryFolder folder;
  const auto path = folder / "asset.glb";
  save_asset(sample_asset(), path);
  overwrite(path, with_json(read_file(path), "\"version\":6",
                            "\"version\":6" + std::string(std::size_t{64} << 20, ' ')));
  CHECK_THROWS_WITH(load_asset(path), Contains("damaged") && Contains("at most 67108864"));
}

TEST_CASE("A reason that quotes long text from a file is cut") {
  const TemporaryFolder folder;
  const auto path = folder / "asset.glb";
  save_asset(sample_asset(), path);
  overwrite(path, with_json(read_file(path), "\"density\":1100",
                            "\"density\":" + std::string(100'000, '9')));
  try {
    load_asset(path);
    FAIL("it was loaded");
  } catch (const IoError& error) {
    CHECK_THAT(error.what(), Contains("damaged") && Contains("999"));
    CHECK(std::string(error.what()).size() < 1000);
  }
}

TEST_CASE("A file truncated anywhere is rejected") {
  const TemporaryFolder folder;
  save_asset(sample_asset(), folder / "asset.glb");
  const std::string bytes = read_file(folder / "asset.glb");
  for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 40) {
    overwrite(folder / "cut.glb", std::string_view(bytes).substr(0, length));
    CHECK_THROWS_AS(load_asset(folder / "cut.glb"), IoError);
  }
}

TEST_CASE("A flipped bit is rejected wherever it is", "[long]") {
  const TemporaryFolder folder;
  save_asset(sample_asset(), folder / "asset.glb");
  const std::string bytes = read_file(folder / "asset.glb");
  const Layout layout(bytes);
  // Every byte of the headers and of the JSON, every 13th of the arrays, also of those that only
  // viewers use.
  std::size_t tried = 0;
  for (std::size_t byte = 0; byte < bytes.size(); byte += byte < layout.binary_begin ? 1 : 13) {
    std::string flipped = bytes;
    flipped[byte] = static_cast<char>(flipped[byte] ^ (1 << (tried++ * 5 % 8)));
    INFO("byte " << byte);
    CHECK_THROWS_AS(parse_asset(flipped, "flipped.glb"), IoError);
  }
}

TEST_CASE("Every flipped bit of the checksum, of arrays and of their description is rejected",
          "[long]") {
  const TemporaryFolder folder;
  save_asset(sample_asset(), folder / "asset.glb");
  const std::string bytes = read_file(folder / "asset.glb");
  const Layout layout(bytes);
  std::vector<std::size_t> places;
  // The first array is the rest positions of level 0: 80 nodes of 24 bytes.
  for (std::size_t i = 0; i < 1920; i += 7) places.push_back(layout.binary_begin + i);
  for (const char* text : {"\"nodes\":80", "\"steel\"", "\"a first key\"", "\"ends\":{", "7850.1"})
    places.push_back(bytes.find(text) + 2);
  for (std::size_t i = 0; i < 14; ++i) places.push_back(bytes.find("crc32:") + i);
  for (const std::size_t byte : places)
    for (int bit = 0; bit < 8; ++bit) {
      std::string flipped = bytes;
      flipped[byte] = static_cast<char>(flipped[byte] ^ (1 << bit));
      INFO("byte " << byte << ", bit " << bit);
      CHECK_THROWS_AS(parse_asset(flipped, "flipped.glb"), IoError);
    }
}

TEST_CASE("The checksum is the CRC-32 of zlib, of the file without it") {
  CHECK(crc_text({"1234", "", "56789"}) == "crc32:cbf43926");  // the check value of CRC-32
  CHECK(checksum_of_file("12crc32:abcdef00", "crc32:abcdef00") == crc_text({"12", kNoChecksum}));
  CHECK(checksum_of_file("123", "crc32:abcdef00").empty());
  const TemporaryFolder folder;
  save_asset(sample_asset(), folder / "asset.glb");
  std::string bytes = read_file(folder / "asset.glb");
  const std::string stated = bytes.substr(bytes.find("crc32:"), kNoChecksum.size());
  bytes.replace(bytes.find(stated), stated.size(), kNoChecksum);
  CHECK(crc_text({bytes}) == stated);
}

}  // namespace
}  // namespace springlod
