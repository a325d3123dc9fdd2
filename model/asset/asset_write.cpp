#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

#include "base/error.hpp"
#include "base/file.hpp"
#include "model/asset/asset.hpp"
#include "model/asset/asset_buffer.hpp"
#include "model/asset/asset_certificate.hpp"
#include "model/asset/asset_display.hpp"
#include "model/asset/asset_format.hpp"
#include "model/asset/asset_json.hpp"

namespace springlod::inline model {
namespace {

using nlohmann::json;

/// Puts the exact arrays into the buffer and describes them in the extension.
class ExactWriter {
 public:
  explicit ExactWriter(AssetBuffer& buffer) : buffer_(buffer) {}

  /// Buffer view of each level's springs' ends; -1 for none.
  std::vector<int> spring_ends;

  json describe(const LodAsset& asset) {
    json extension{{"version", asset_format::kVersion}};
    // tinygltf writes an empty array as null, so empty ones are left out, here and below.
    for (const auto& [key, value] : asset.provenance.entries)
      extension["provenance"].push_back({utf8(key), utf8(value)});
    for (const Level& level : asset.chain.levels) extension["levels"].push_back(describe(level));
    if (!asset.surface.positions.empty() || !asset.surface.parts.empty() ||
        !asset.surface_of_base.start.empty())
      extension["surface"] = describe(asset.surface, asset.surface_of_base);
    checksum_.add(extension.dump());
    extension["checksum"] = checksum_.text();
    return extension;
  }

 private:
  template <class T>
  int put(json& object, const char* key, const std::vector<T>& array, int target = 0) {
    checksum_.add({reinterpret_cast<const char*>(array.data()), array.size() * sizeof(T)});
    if (array.empty()) return -1;
    const int view = buffer_.add(array, target);
    object[key] = view;
    return view;
  }

  static json describe(const Material& material) {
    return {{"name", utf8(material.name)},
            {"young", material.young},
            {"density", material.density},
            {"damping", material.damping},
            {"colour", {material.colour.r, material.colour.g, material.colour.b}}};
  }

  json describe(const Level& level) {
    const MassSpringModel& model = level.model;
    json object{{"nodes", whole_number(model.node_count())},
                {"springs", whole_number(model.spring_count())},
                {"madeBy", utf8(level.made_by)}};
    for (const Material& material : model.materials)
      object["materials"].push_back(describe(material));
    put(object, "rest", model.rest);
    put(object, "mass", model.mass);
    put(object, "volume", model.volume);
    put(object, "contactArea", model.contact_area);
    put(object, "border", model.border);
    put(object, "material", model.material);
    std::vector<std::uint32_t> ends;
    ends.reserve(model.end_count());
    for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
      ends.push_back(model.a[s]);
      ends.push_back(model.b[s]);
    }
    spring_ends.push_back(put(object, "ends", ends, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER));
    put(object, "restLength", model.rest_length);
    put(object, "stiffness", model.stiffness);
    put(object, "damping", model.damping);
    put(object, "nodeOfBase", level.of_base.of);
    if (level.certificate) object["certificate"] = certificate_json(*level.certificate);
    return object;
  }

  json describe(const TriangleMesh& surface, const Binding& binding) {
    json object{{"vertices", whole_number(surface.positions.size())},
                {"triangles", whole_number(surface.triangles.size())}};
    for (const MeshPart& part : surface.parts)
      object["parts"].push_back({{"name", utf8(part.name)},
                                 {"material", utf8(part.material)},
                                 {"firstTriangle", whole_number(part.first_triangle)},
                                 {"triangleCount", whole_number(part.triangle_count)}});
    put(object, "positions", surface.positions);
    put(object, "indices", surface.triangles);
    put(object, "bindingStart", binding.start);
    put(object, "bindingNode", binding.node);
    put(object, "bindingWeight", binding.weight);
    return object;
  }

  AssetBuffer& buffer_;
  asset_format::Checksum checksum_;
};

/// About what the buffer will hold: 112 B a node and 32 B a spring, and so on, rounded up.
std::size_t expected_bytes(const LodAsset& asset) {
  std::size_t bytes = std::size_t{64} * 1024;
  for (const Level& level : asset.chain.levels)
    bytes +=
        128 * level.model.rest.size() + 32 * level.model.a.size() + 4 * level.of_base.of.size();
  return bytes + 64 * asset.surface.positions.size() + 12 * asset.surface.triangles.size() +
         12 * asset.surface_of_base.node.size();
}

}  // namespace

void save_asset(const LodAsset& asset, const std::filesystem::path& path) {
  validate(asset);
  tinygltf::Model gltf;
  gltf.asset.version = "2.0";
  gltf.asset.generator = "springlod";
  AssetBuffer buffer(gltf);
  buffer.reserve(expected_bytes(asset));
  ExactWriter exact(buffer);
  gltf.extensions[asset_format::kExtension] = gltf_value(exact.describe(asset));
  gltf.extensionsUsed = {asset_format::kExtension};
  add_display(asset, exact.spring_ends, gltf, buffer);

  // Lengths in a .glb are 32 bits; the JSON wants some of it.
  constexpr std::size_t kLargestBuffer = 0xF0000000;
  if (gltf.buffers[0].data.size() > kLargestBuffer)
    throw IoError(
        fmt::format("cannot write {}: {} bytes do not fit into a .glb file (4 GB); use "
                    "larger cells or fewer levels",
                    path.string(), gltf.buffers[0].data.size()));
  write_aside(path, [&](const std::filesystem::path& aside) {
    std::ofstream out(aside, std::ios::binary);
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&gltf, out, false, true);
    out.close();
    if (!out)
      throw IoError(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
  });
}

}  // namespace springlod::inline model
