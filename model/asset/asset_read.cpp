#include <array>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "model/asset/asset.hpp"
#include "model/asset/asset_certificate.hpp"
#include "model/asset/asset_format.hpp"
#include "model/asset/glb.hpp"

// The extension is read with a JSON parser and explicit range checks. A general glTF reader would
// follow every reference of a damaged file.

namespace springlod::inline model {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestValue = 40;  // of a wrong value in a message [characters]

// A whole number of at most `most`. json::get would convert negative numbers and fractions.
std::uint64_t whole(const json& number, std::uint64_t most) {
  if (!number.is_number_unsigned() || number.get<std::uint64_t>() > most)
    throw Damage(fmt::format("{} stands where a whole number of at most {} must stand",
                             number.dump().substr(0, kLongestValue), most));
  return number.get<std::uint64_t>();
}

std::uint32_t whole(const json& number) {
  return static_cast<std::uint32_t>(whole(number, std::numeric_limits<std::uint32_t>::max()));
}

/// Builds the asset from the extension and verifies the checksum.
class ExactReader {
 public:
  ExactReader(const json& gltf, std::string_view binary)
      : views_(gltf.at("bufferViews")), binary_(binary) {}

  LodAsset read(const json& extension) {
    LodAsset asset;
    if (extension.contains("provenance"))
      for (const json& entry : extension.at("provenance"))
        asset.provenance.entries.emplace_back(entry.at(0).get<std::string>(),
                                              entry.at(1).get<std::string>());
    if (extension.contains("contact")) asset.chain.contact = read_contact(extension.at("contact"));
    has_corners_ = whole(extension.at("version")) >= asset_format::kVersionWithCorners;
    for (const json& level : extension.at("levels"))
      asset.chain.levels.push_back(read_level(level, asset.chain.levels.size()));
    if (extension.contains("surface")) read_surface(extension.at("surface"), asset);

    json rest = extension;
    rest.erase("checksum");
    checksum_.add(rest.dump());
    if (checksum_.text() != extension.at("checksum").get<std::string>())
      throw Damage("its contents do not match its checksum");
    return asset;
  }

 private:
  std::string_view view(const json& number) const {
    const json& v = views_.at(whole(number));
    const std::uint64_t offset = v.contains("byteOffset") ? whole(v.at("byteOffset")) : 0;
    const std::uint64_t length = whole(v.at("byteLength"));
    if (whole(v.at("buffer")) != 0 || offset > binary_.size() || length > binary_.size() - offset)
      throw Damage("an array lies outside the file");
    return binary_.substr(offset, length);
  }

  template <class T>
  std::vector<T> take(const json& object, const char* key) {
    const std::string_view bytes = object.contains(key) ? view(object.at(key)) : std::string_view{};
    if (bytes.size() % sizeof(T) != 0) throw Damage(fmt::format("its array {} is cut short", key));
    checksum_.add(bytes);
    std::vector<T> array(bytes.size() / sizeof(T));
    if (!bytes.empty()) std::memcpy(static_cast<void*>(array.data()), bytes.data(), bytes.size());
    return array;
  }

  static ContactAt read_contact(const json& word) {
    const auto contact = from_string<ContactAt>(word.get<std::string>());
    if (!contact) throw Damage("its contact points are of an unknown kind");
    return *contact;
  }

  static Material read_material(const json& object) {
    const json& colour = object.at("colour");
    return {object.at("name").get<std::string>(),
            object.at("young").get<double>(),
            object.at("density").get<double>(),
            object.at("damping").get<double>(),
            {colour.at(0).get<float>(), colour.at(1).get<float>(), colour.at(2).get<float>()}};
  }

  std::vector<Corner> read_corners(const json& object) {
    const auto nodes = take<std::array<std::uint32_t, 4>>(object, "cornerNodes");
    const auto young = take<double>(object, "cornerYoung");
    const auto number = take<std::uint32_t>(object, "cornerYoungNumber");
    if (number.empty() ? young.size() > 1 || young.empty() != nodes.empty()
                       : number.size() != nodes.size())
      throw Damage("the moduli of its corners do not fit its corners");
    std::vector<Corner> corners(nodes.size());
    for (std::size_t c = 0; c < nodes.size(); ++c) {
      const std::size_t at = number.empty() ? 0 : number[c];
      if (at >= young.size()) throw Damage("a corner refers to a modulus that does not exist");
      corners[c] = {nodes[c], young[at]};
    }
    return corners;
  }

  Level read_level(const json& object, std::size_t number) {
    Level level;
    MassSpringModel& model = level.model;
    level.made_by = object.at("madeBy").get<std::string>();
    for (const json& material : object.at("materials"))
      model.materials.push_back(read_material(material));
    model.rest = take<Vec3>(object, "rest");
    model.mass = take<double>(object, "mass");
    model.volume = take<double>(object, "volume");
    model.contact_area = take<double>(object, "contactArea");
    model.border = take<std::uint8_t>(object, "border");
    model.material = take<std::uint32_t>(object, "material");
    for (const auto& [a, b] : take<std::array<std::uint32_t, 2>>(object, "ends")) {
      model.a.push_back(a);
      model.b.push_back(b);
    }
    model.rest_length = take<double>(object, "restLength");
    model.stiffness = take<double>(object, "stiffness");
    model.damping = take<double>(object, "damping");
    level.of_base.of = take<std::uint32_t>(object, "nodeOfBase");
    level.of_base.count = model.node_count();
    if (has_corners_) model.corners = read_corners(object);
    if (object.contains("certificate"))
      level.certificate = read_certificate(object.at("certificate"),
                                           fmt::format("the certificate of level {}", number));
    return level;
  }

  void read_surface(const json& object, LodAsset& asset) {
    if (object.contains("parts"))
      for (const json& part : object.at("parts"))
        asset.surface.parts.push_back(
            {part.at("name").get<std::string>(), part.at("material").get<std::string>(),
             whole(part.at("firstTriangle")), whole(part.at("triangleCount"))});
    asset.surface.positions = take<Vec3>(object, "positions");
    asset.surface.triangles = take<Triangle>(object, "indices");
    asset.surface_of_base.start = take<std::uint32_t>(object, "bindingStart");
    asset.surface_of_base.node = take<std::uint32_t>(object, "bindingNode");
    asset.surface_of_base.weight = take<double>(object, "bindingWeight");
  }

  const json& views_;
  std::string_view binary_;
  bool has_corners_ = false;
  asset_format::Checksum checksum_;
};

const json* find_extension(const json& gltf) {
  const auto extensions = gltf.find("extensions");
  if (extensions == gltf.end() || !extensions->is_object()) return nullptr;
  const auto ours = extensions->find(asset_format::kExtension);
  return ours == extensions->end() ? nullptr : &*ours;
}

}  // namespace

LodAsset load_asset(const std::filesystem::path& path) {
  const std::string file = read_file(path);
  const std::string name = path.string();
  if (!is_glb(file))
    throw IoError(
        fmt::format("{} is not a .glb file (binary glTF); springlod convert makes one from "
                    "a mesh",
                    name));
  try {
    const GlbChunks chunks = split_glb(file);
    const json gltf = json::parse(chunks.json);
    const json* extension = find_extension(gltf);
    if (extension == nullptr)
      throw IoError(
          fmt::format("{} has no level-of-detail chain (extension {}); springlod "
                      "convert makes one from a mesh",
                      name, asset_format::kExtension));
    const std::uint32_t version = whole(extension->at("version"));
    if (version == 0) throw Damage("its format version is 0");
    if (version > asset_format::kVersion)
      throw IoError(
          fmt::format("{} has format version {}; this program reads versions up to {}; update "
                      "springlod",
                      name, version, asset_format::kVersion));
    LodAsset asset = ExactReader(gltf, chunks.binary).read(*extension);
    validate(asset);
    return asset;
  } catch (const Damage& e) {
    throw IoError(fmt::format("{} is damaged: {}; make it again", name, e.what()));
  } catch (const json::exception& e) {
    throw IoError(fmt::format("{} is damaged: {}; make it again", name, e.what()));
  } catch (const InputError& e) {
    throw IoError(fmt::format("{} is damaged: {}; make it again", name, e.what()));
  }
}

}  // namespace springlod::inline model
