#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "model/asset/array_reader.hpp"
#include "model/asset/asset.hpp"
#include "model/asset/asset_certificate.hpp"
#include "model/asset/asset_format.hpp"
#include "model/asset/checksum.hpp"
#include "model/asset/field_reader.hpp"
#include "model/asset/glb.hpp"

// The extension is read with a JSON parser and explicit range checks. A general glTF reader would
// follow every reference of a damaged file.

namespace springlod::inline model {
namespace {

using nlohmann::json;

// Messages may quote what stands in the file, of any length [characters].
constexpr int kLongestReason = 300;

ContactAt read_contact(const std::string& word) {
  const auto contact = from_string<ContactAt>(word);
  if (!contact) throw Damage("its contact points are of an unknown kind");
  return *contact;
}

Colour read_colour(const json& list, const std::string& owner) {
  if (!list.is_array() || list.size() != 3 ||
      !std::all_of(list.begin(), list.end(), [](const json& c) { return c.is_number(); }))
    throw InputError(fmt::format("{}: 'colour' must be a list of three numbers", owner));
  return {list[0].get<float>(), list[1].get<float>(), list[2].get<float>()};
}

Material read_material(const json& object, const std::string& owner) {
  const FieldReader from(object, owner);
  return {from.text("name"),
          from.number("young"),
          from.number("density"),
          from.number("damping"),
          read_colour(object.value("colour", json()), owner),
          from.optional_number("poisson").value_or(kSpringPoisson)};
}

void read_provenance(const FieldReader& extension, Provenance& provenance) {
  extension.each("provenance", [&](const json& entry, const std::string& name) {
    if (!entry.is_array() || entry.size() != 2 || !entry[0].is_string() || !entry[1].is_string())
      throw InputError(fmt::format("{} must be a pair of texts", name));
    provenance.entries.emplace_back(entry[0].get<std::string>(), entry[1].get<std::string>());
  });
}

std::vector<Corner> read_corners(const FieldReader& from, ArrayReader& arrays) {
  const std::uint32_t count = from.optional_count("corners");
  const auto nodes = arrays.take<std::array<std::uint32_t, 4>>(from, "cornerNodes", count);
  const auto young = arrays.take_any<double>(from, "cornerYoung");
  const auto number = arrays.take_any<std::uint32_t>(from, "cornerYoungNumber");
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

DilatationTerms read_dilatation(const FieldReader& from, ArrayReader& arrays) {
  DilatationTerms terms;
  const std::uint32_t count = from.optional_count("terms");
  if (count == 0) return terms;
  terms.modulus = arrays.take<double>(from, "termModulus", count);
  terms.damping_time = arrays.take<double>(from, "termDampingTime", count);
  terms.start = arrays.take<std::uint32_t>(from, "termStart", count + 1ULL);
  terms.node = arrays.take<std::uint32_t>(from, "termNode", terms.start.back());
  terms.gradient = arrays.take<Vec3>(from, "termGradient", terms.start.back());
  return terms;
}

ContactSurface read_contact_surface(const FieldReader& from, ArrayReader& arrays) {
  ContactSurface surface;
  const std::uint32_t count = from.optional_count("contactPoints");
  if (count == 0) return surface;
  surface.of_nodes.start = arrays.take<std::uint32_t>(from, "contactStart", count + 1ULL);
  const std::uint32_t entries = surface.of_nodes.start.back();
  surface.of_nodes.node = arrays.take<std::uint32_t>(from, "contactNode", entries);
  surface.of_nodes.weight = arrays.take<double>(from, "contactWeight", entries);
  surface.normal = arrays.take<Vec3>(from, "contactNormal", count);
  surface.area = arrays.take<double>(from, "contactPointArea", count);
  surface.stiffness = arrays.take<double>(from, "contactStiffness", count);
  return surface;
}

void read_ends(const FieldReader& from, ArrayReader& arrays, MassSpringModel& model,
               std::uint32_t spring_count) {
  const auto ends = arrays.take<std::array<std::uint32_t, 2>>(from, "ends", spring_count);
  model.a.reserve(ends.size());
  model.b.reserve(ends.size());
  for (const auto& [a, b] : ends) {
    model.a.push_back(a);
    model.b.push_back(b);
  }
}

/// Rest lengths that a slim asset omits: the distances of the ends. The array counts as empty.
std::vector<double> distances(const MassSpringModel& model, ArrayReader& arrays) {
  arrays.add_to_checksum({});
  std::vector<double> lengths;
  lengths.reserve(model.spring_count());
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    if (model.a[s] >= model.node_count() || model.b[s] >= model.node_count())
      throw Damage("a spring refers to a node that does not exist");
    lengths.push_back((model.rest[model.b[s]] - model.rest[model.a[s]]).norm());
  }
  return lengths;
}

/// Checks the map from a level of a slim asset to level 0. It is for engines: here, the map follows
/// from the level.
void read_map_to_base(const FieldReader& from, ArrayReader& arrays, std::uint32_t nodes,
                      std::uint32_t base_nodes) {
  if (!from.has("baseStart")) return;
  Binding map;
  map.start = arrays.take<std::uint32_t>(from, "baseStart", base_nodes + 1ULL);
  map.node = arrays.take<std::uint32_t>(from, "baseNode", map.start.back());
  map.weight = arrays.take<double>(from, "baseWeight", map.start.back());
  validate(map, nodes);
}

/// Builds the asset from the extension and verifies the checksum.
class ExactReader {
 public:
  ExactReader(const json& gltf, std::string_view binary, std::uint32_t version)
      : arrays_(gltf, binary, version), version_(version) {}

  /// `file`: all of it, whose checksum is verified.
  LodAsset read(const json& extension, std::string_view file) {
    const FieldReader from(extension, "the extension");
    LodAsset asset;
    read_provenance(from, asset.provenance);
    if (from.has("contact")) asset.chain.contact = read_contact(from.text("contact"));
    from.each("levels", [&](const json& level, const std::string&) {
      const std::size_t number = asset.chain.levels.size();
      asset.chain.levels.push_back(
          read_level(level, number, number == 0 ? 0 : asset.chain.levels[0].model.node_count()));
    });
    if (from.has("surface")) read_surface(extension["surface"], asset);
    verify_checksum(extension, from.text("checksum"), file);
    return asset;
  }

 private:
  // `base_nodes`: the number of nodes of level 0, not used for level 0 itself.
  Level read_level(const json& object, std::size_t number, std::uint32_t base_nodes) {
    const FieldReader from(object, fmt::format("level {}", number));
    const std::uint32_t nodes = from.count("nodes");
    const std::uint32_t springs = from.optional_count("springs");
    Level level;
    MassSpringModel& model = level.model;
    level.made_by = from.text("madeBy");
    from.each("materials", [&](const json& material, const std::string& name) {
      model.materials.push_back(read_material(material, name));
    });
    model.rest = arrays_.take<Vec3>(from, "rest", nodes);
    model.mass = arrays_.take<double>(from, "mass", nodes);
    model.volume = arrays_.take<double>(from, "volume", nodes);
    model.contact_area = arrays_.take<double>(from, "contactArea", nodes);
    model.border = arrays_.take<std::uint8_t>(from, "border", nodes);
    model.material = arrays_.take<std::uint32_t>(from, "material", nodes);
    read_ends(from, arrays_, model, springs);
    if (version_ >= asset_format::kVersionWithSlim && ArrayReader::is_empty(from, "restLength"))
      model.rest_length = distances(model, arrays_);
    else
      model.rest_length = arrays_.take<double>(from, "restLength", springs);
    model.stiffness = arrays_.take<double>(from, "stiffness", springs);
    model.damping = arrays_.take<double>(from, "damping", springs);
    level.of_base.of =
        arrays_.take<std::uint32_t>(from, "nodeOfBase", number == 0 ? nodes : base_nodes);
    level.of_base.count = nodes;
    if (version_ >= asset_format::kVersionWithCorners) model.corners = read_corners(from, arrays_);
    if (version_ >= asset_format::kVersionWithDilatation)
      model.dilatation = read_dilatation(from, arrays_);
    if (version_ >= asset_format::kVersionWithSurface)
      model.surface = read_contact_surface(from, arrays_);
    if (version_ >= asset_format::kVersionWithSlim)
      read_map_to_base(from, arrays_, nodes, base_nodes);
    if (from.has("certificate"))
      level.certificate = read_certificate(object["certificate"],
                                           fmt::format("the certificate of level {}", number));
    return level;
  }

  void read_surface(const json& object, LodAsset& asset) {
    const FieldReader from(object, "the surface");
    const std::uint32_t vertices = from.count("vertices");
    from.each("parts", [&](const json& entry, const std::string& name) {
      const FieldReader part(entry, name);
      asset.surface.parts.push_back({part.text("name"), part.text("material"),
                                     part.count("firstTriangle"), part.count("triangleCount")});
    });
    asset.surface.positions = arrays_.take<Vec3>(from, "positions", vertices);
    asset.surface.triangles = arrays_.take<Triangle>(from, "indices", from.count("triangles"));
    Binding& binding = asset.surface_of_base;
    // Without vertices, the start may be missing.
    binding.start = arrays_.take<std::uint32_t>(
        from, "bindingStart",
        vertices > 0 || !ArrayReader::is_empty(from, "bindingStart") ? vertices + 1ULL : 0);
    const std::uint32_t entries = binding.start.empty() ? 0 : binding.start.back();
    binding.node = arrays_.take<std::uint32_t>(from, "bindingNode", entries);
    binding.weight = arrays_.take<double>(from, "bindingWeight", entries);
  }

  void verify_checksum(const json& extension, const std::string& stated, std::string_view file) {
#ifndef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION  // a fuzzer would hardly pass it
    if (checksum_of(extension, stated, file) != stated)
      throw Damage("its contents do not match its checksum");
#endif
  }

  std::string checksum_of(const json& extension, const std::string& stated, std::string_view file) {
    if (version_ >= asset_format::kVersionWithCrc) return checksum_of_file(file, stated);
    json rest = extension;
    rest.erase("checksum");
    arrays_.add_to_checksum(rest.dump());
    return arrays_.old_checksum();
  }

  ArrayReader arrays_;
  std::uint32_t version_;
};

const json* find_extension(const json& gltf) {
  const auto extensions = gltf.find("extensions");
  if (extensions == gltf.end() || !extensions->is_object()) return nullptr;
  const auto ours = extensions->find(asset_format::kExtension);
  return ours == extensions->end() ? nullptr : &*ours;
}

}  // namespace

LodAsset load_asset(const std::filesystem::path& path) {
  return parse_asset(read_file(path), path.string());
}

LodAsset parse_asset(std::string_view file, const std::string& name) {
  if (!is_glb(file))
    throw IoError(
        fmt::format("{} is not a .glb file (binary glTF); springlod convert makes one from "
                    "a mesh",
                    name));
  const auto damaged = [&](std::string_view reason) {
    return IoError(
        fmt::format("{} is damaged: {:.{}}; make it again", name, reason, kLongestReason));
  };
  try {
    const GlbChunks chunks = split_glb(file);
    const json gltf = json::parse(chunks.json);
    const json* extension = find_extension(gltf);
    if (extension == nullptr)
      throw IoError(
          fmt::format("{} has no level-of-detail chain (extension {}); springlod "
                      "convert makes one from a mesh",
                      name, asset_format::kExtension));
    const std::uint32_t version = FieldReader(*extension, "the extension").count("version");
    if (version == 0) throw Damage("its format version is 0");
    if (version > asset_format::kVersion)
      throw IoError(
          fmt::format("{} has format version {}; this program reads versions up to {}; update "
                      "springlod",
                      name, version, asset_format::kVersion));
    LodAsset asset = ExactReader(gltf, chunks.binary, version).read(*extension, file);
    validate(asset);
    return asset;
  } catch (const Damage& e) {
    throw damaged(e.what());
  } catch (const json::parse_error& e) {
    throw damaged(fmt::format("its JSON chunk is not valid at byte {}", e.byte));
  } catch (const json::exception& e) {
    throw damaged(e.what());
  } catch (const InputError& e) {
    throw damaged(e.what());
  }
}

}  // namespace springlod::inline model
