#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "model/asset/asset.hpp"
#include "model/asset/asset_buffer.hpp"
#include "model/asset/asset_certificate.hpp"
#include "model/asset/asset_display.hpp"
#include "model/asset/asset_format.hpp"
#include "model/asset/checksum.hpp"
#include "model/asset/glb.hpp"
#include "model/asset/gltf_builder.hpp"
#include "model/asset/slim_asset.hpp"
#include "model/asset/small_arrays.hpp"

namespace springlod::inline model {
namespace {

using nlohmann::json;

/// The type of the numbers of an array in full precision, as the file states it.
template <class T>
constexpr const char* exact_type() {
  using Scalar = asset_format::ScalarOf<T>;
  return std::is_same_v<Scalar, double> ? "float64" : sizeof(Scalar) == 1 ? "uint8" : "uint32";
}

/// Writes the arrays to the buffer and describes them in the extension: in double precision, or as
/// those of a slim asset.
class ArrayWriter {
 public:
  /// `slim`: what a slim asset has besides of each level; null for a whole one.
  explicit ArrayWriter(AssetBuffer& buffer, const std::vector<SlimLevel>* slim = nullptr)
      : buffer_(buffer), small_(buffer), slim_(slim) {}

  json describe(const LodAsset& asset) {
    json extension{{"version", asset_format::kVersion}, {"checksum", kNoChecksum}};
    extension["provenance"] = json::array();
    for (const auto& [key, value] : asset.provenance.entries)
      extension["provenance"].push_back({key, value});
    if (asset.chain.contact != ContactAt::nodes)
      extension["contact"] = to_string(asset.chain.contact);
    for (const Level& level : asset.chain.levels) {
      json& object = extension["levels"].emplace_back(describe(level));
      if (slim_)
        add_slim(object, (*slim_)[extension["levels"].size() - 1]);
      else
        add_stable_step(object, level, asset.chain);
    }
    if (!asset.surface.positions.empty() || !asset.surface.parts.empty() ||
        !asset.surface_of_base.start.empty())
      extension["surface"] = describe(asset.surface, asset.surface_of_base);
    return extension;
  }

 private:
  /// glTF has no empty views: empty arrays are empty lists.
  template <class T>
  void put(json& object, const char* key, const std::vector<T>& array,
           gltf::Target target = gltf::Target::none) {
    json& place = object[key] = json::array();
    if (array.empty()) return;
    place = slim_ ? small(array, target)
                  : json{{"view", buffer_.add(array, target)}, {"type", exact_type<T>()}};
    if (asset_format::kWidthOf < T >> 1) place["width"] = asset_format::kWidthOf<T>;
  }

  json small(const std::vector<Vec3>& array, gltf::Target target) {
    return small_.vectors(array, target);
  }
  json small(const std::vector<double>& array, gltf::Target /*target*/) {
    return small_.numbers(array);
  }
  json small(const std::vector<std::uint8_t>& array, gltf::Target target) {
    const std::vector<std::uint32_t> wide(array.begin(), array.end());
    return small(wide, target);
  }
  /// Of uint32 or tuples of them.
  template <class T>
  json small(const std::vector<T>& array, gltf::Target target) {
    static_assert(sizeof(T) % sizeof(std::uint32_t) == 0);
    return small_.integers(reinterpret_cast<const std::uint32_t*>(array.data()),
                           array.size() * sizeof(T) / sizeof(std::uint32_t), target);
  }

  void put_weights(json& object, const char* key, const std::vector<double>& weights) {
    if (slim_ && !weights.empty())
      object[key] = small_.weights(weights);
    else
      put(object, key, weights);
  }

  /// Empty in a slim asset if each is the distance of the spring's ends.
  std::vector<double> rest_lengths(const MassSpringModel& model) const {
    for (std::uint32_t s = 0; s < model.spring_count(); ++s)
      if (!slim_ ||
          model.rest_length[s] != (model.rest[model.b[s]] - model.rest[model.a[s]]).norm())
        return model.rest_length;
    return {};
  }

  void add_slim(json& object, const SlimLevel& slim) {
    object["stableStep"] = slim.stable_step;
    if (slim.of_level.start.empty()) return;
    put(object, "baseStart", slim.of_level.start);
    put(object, "baseNode", slim.of_level.node);
    put_weights(object, "baseWeight", slim.of_level.weight);
  }

  /// Certificates know the stable steps: each that of its level, and all that of the base.
  static void add_stable_step(json& object, const Level& level, const LodChain& chain) {
    const auto& of_last = chain.levels.back().certificate;
    if (level.certificate)
      object["stableStep"] = level.certificate->stable_step;
    else if (&level == &chain.levels.front() && of_last)
      object["stableStep"] = of_last->base_stable_step;
    else
      object["stableStep"] = nullptr;
  }

  static json describe(const Material& material) {
    json object{{"name", material.name},
                {"young", material.young},
                {"density", material.density},
                {"damping", material.damping},
                {"colour", {material.colour.r, material.colour.g, material.colour.b}}};
    if (material.poisson != kSpringPoisson) object["poisson"] = material.poisson;
    return object;
  }

  /// The nodes of each corner, the different Young's moduli, and the modulus of each corner. A body
  /// of few materials has few moduli; if there is only one, no number of it is written.
  void put_corners(json& object, const std::vector<Corner>& corners) {
    std::vector<std::array<std::uint32_t, 4>> nodes;
    std::vector<double> young;
    nodes.reserve(corners.size());
    young.reserve(corners.size());
    for (const Corner& corner : corners) {
      nodes.push_back(corner.node);
      young.push_back(corner.young);
    }
    std::sort(young.begin(), young.end());
    young.erase(std::unique(young.begin(), young.end()), young.end());
    std::vector<std::uint32_t> young_of;
    if (young.size() > 1) {
      young_of.reserve(corners.size());
      for (const Corner& corner : corners)
        young_of.push_back(static_cast<std::uint32_t>(
            std::lower_bound(young.begin(), young.end(), corner.young) - young.begin()));
    }
    object["corners"] = corners.size();
    put(object, "cornerNodes", nodes);
    put(object, "cornerYoung", young);
    put(object, "cornerYoungNumber", young_of);
  }

  void put_dilatation(json& object, const DilatationTerms& terms) {
    if (terms.empty()) return;
    object["terms"] = terms.count();
    put(object, "termModulus", terms.modulus);
    put(object, "termDampingTime", terms.damping_time);
    put(object, "termStart", terms.start);
    put(object, "termNode", terms.node);
    put(object, "termGradient", terms.gradient);
  }

  void put_surface(json& object, const ContactSurface& surface) {
    if (surface.empty()) return;
    object["contactPoints"] = surface.count();
    put(object, "contactStart", surface.of_nodes.start);
    put(object, "contactNode", surface.of_nodes.node);
    put_weights(object, "contactWeight", surface.of_nodes.weight);
    put(object, "contactNormal", surface.normal);
    put(object, "contactPointArea", surface.area);
    put(object, "contactStiffness", surface.stiffness);
  }

  json describe(const Level& level) {
    const MassSpringModel& model = level.model;
    json object{{"nodes", model.node_count()},
                {"springs", model.spring_count()},
                {"madeBy", level.made_by},
                {"materials", json::array()}};
    for (const Material& material : model.materials)
      object["materials"].push_back(describe(material));
    put(object, "rest", model.rest, slim_ ? gltf::Target::vertices : gltf::Target::none);
    put(object, "mass", model.mass);
    put(object, "volume", model.volume);
    put(object, "contactArea", model.contact_area);
    put(object, "border", model.border);
    put(object, "material", model.material);
    std::vector<std::array<std::uint32_t, 2>> ends;
    ends.reserve(model.spring_count());
    for (std::uint32_t s = 0; s < model.spring_count(); ++s)
      ends.push_back({model.a[s], model.b[s]});
    put(object, "ends", ends, gltf::Target::indices);
    put(object, "restLength", rest_lengths(model));
    put(object, "stiffness", model.stiffness);
    put(object, "damping", model.damping);
    put(object, "nodeOfBase", level.of_base.of);
    put_corners(object, model.corners);
    put_dilatation(object, model.dilatation);
    put_surface(object, model.surface);
    if (level.certificate) object["certificate"] = certificate_json(*level.certificate);
    return object;
  }

  json describe(const TriangleMesh& surface, const Binding& binding) {
    json object{{"vertices", surface.positions.size()},
                {"triangles", surface.triangles.size()},
                {"parts", json::array()}};
    for (const MeshPart& part : surface.parts)
      object["parts"].push_back({{"name", part.name},
                                 {"material", part.material},
                                 {"firstTriangle", part.first_triangle},
                                 {"triangleCount", part.triangle_count}});
    // The scene of a slim asset uses the same views.
    const bool shown = slim_ != nullptr;
    put(object, "positions", surface.positions,
        shown ? gltf::Target::vertices : gltf::Target::none);
    put(object, "indices", surface.triangles, shown ? gltf::Target::indices : gltf::Target::none);
    put(object, "bindingStart", binding.start);
    put(object, "bindingNode", binding.node);
    put_weights(object, "bindingWeight", binding.weight);
    return object;
  }

  AssetBuffer& buffer_;
  SmallArrays small_;
  const std::vector<SlimLevel>* slim_;
};

/// Estimated size of the buffer: 112 B per node, 32 B per spring, 20 B per corner, and 20 B per
/// dilatation term and 28 B per node of it, 44 B per contact point and 12 B per node of it, rounded
/// up.
std::size_t expected_bytes(const LodAsset& asset) {
  std::size_t bytes = std::size_t{64} * 1024;
  for (const Level& level : asset.chain.levels)
    bytes += 128 * level.model.rest.size() + 32 * level.model.a.size() +
             20 * level.model.corners.size() + 4 * level.of_base.of.size() +
             20 * level.model.dilatation.modulus.size() + 28 * level.model.dilatation.node.size() +
             44 * level.model.surface.area.size() + 12 * level.model.surface.of_nodes.node.size();
  return bytes + 64 * asset.surface.positions.size() + 12 * asset.surface.triangles.size() +
         12 * asset.surface_of_base.node.size();
}

void set_extension(json& document, json extension) {
  document["extensionsUsed"] = {asset_format::kExtension};
  document["extensions"] = {{asset_format::kExtension, std::move(extension)}};
}

void write(GltfBuilder& gltf, const std::filesystem::path& path) {
  const std::size_t bytes = gltf.buffer().bytes().size();
  if (bytes > kLargestGlbBuffer)
    throw IoError(
        fmt::format("cannot write {}: {} bytes do not fit into a .glb file (4 GB); use "
                    "larger cells or fewer levels",
                    path.string(), bytes));
  GlbPieces glb = gltf.pieces();
  const std::string checksum = crc_text({glb.head, glb.binary, glb.padding});
  glb.head.replace(glb.head.find(kNoChecksum), kNoChecksum.size(), checksum);
  write_aside(path, [&](const std::filesystem::path& aside) {
    std::ofstream out(aside, std::ios::binary);
    write_glb(out, glb);
    out.close();
    if (!out)
      throw IoError(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
  });
}

}  // namespace

void save_asset(const LodAsset& asset, const std::filesystem::path& path) {
  validate(asset);
  GltfBuilder gltf(sizeof(double));
  gltf.buffer().reserve(expected_bytes(asset));
  const json extension = ArrayWriter(gltf.buffer()).describe(asset);
  set_extension(gltf.document(), extension);
  add_display(asset, extension, gltf);
  write(gltf, path);
}

void save_slim_asset(const LodAsset& asset, const std::vector<SlimLevel>& levels,
                     const std::filesystem::path& path) {
  const std::vector<Level>& whole = asset.chain.levels;
  if (levels.size() != whole.size())
    throw InputError(fmt::format("slim asset: {} levels are described, but there are {}",
                                 levels.size(), whole.size()));
  const LodAsset slim = slimmed(asset);
  std::vector<SlimLevel> bound = levels;
  for (std::size_t n = 0; n < bound.size(); ++n)
    bound[n].of_level = slim_binding(levels[n].of_level, whole[n].model.rest);
  GltfBuilder gltf(sizeof(float));
  const json extension = ArrayWriter(gltf.buffer(), &bound).describe(slim);
  set_extension(gltf.document(), extension);
  add_slim_display(slim, extension, gltf);
  write(gltf, path);
}

}  // namespace springlod::inline model
