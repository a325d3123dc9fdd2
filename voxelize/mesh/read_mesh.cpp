#include "voxelize/mesh/read_mesh.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "base/error.hpp"
#include "base/file.hpp"

namespace springlod::voxelize {
namespace {

namespace fs = std::filesystem;

// FBX units are multiples of a centimetre: UnitScaleFactor is the multiple.
constexpr double kFbxUnit = 0.01;
// More characters than any <unit> element has: bounds the search in a damaged file.
constexpr std::size_t kLongTag = 1000;

struct Format {
  std::string_view ending;
  std::string_view name;
};
constexpr Format kFormats[] = {
    {".obj", "OBJ"},   {".stl", "STL"}, {".ply", "PLY"}, {".glb", "glTF"},
    {".gltf", "glTF"}, {".fbx", "FBX"}, {".off", "OFF"}, {".dae", "Collada"},
};

std::string known_formats() {
  return fmt::format("{}", fmt::join(mesh_endings(), ", "));
}

std::string format_of(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Format& format : kFormats)
    if (format.ending == ending) return std::string(format.name);
  throw IoError(fmt::format("{} is not a mesh file of a known format; springlod reads {}",
                            path.string(), known_formats()));
}

// ---------------------------------------------------------------- units and axes

struct FileFrame {
  std::optional<double> unit;  ///< stated by the file or fixed by the format [m]
  std::optional<UpAxis> up;    ///< likewise
  bool up_reversed = false;    ///< FBX: up is the negative axis
  double unit_applied = 1;     ///< factor that assimp has applied already
};

// Metres in the first <unit name="..." meter="..."> of a Collada file; nothing if there is none.
std::optional<double> collada_unit(const std::string& text) {
  const std::size_t start = text.find("<unit");
  if (start == std::string::npos) return std::nullopt;
  const std::string element = text.substr(start, std::min(text.find('>', start) - start, kLongTag));
  constexpr std::string_view kSpace = " \t\r\n";
  constexpr std::string_view kAttribute = "meter";
  // The name may also be "meter": the attribute is followed by an equals sign.
  for (std::size_t at = element.find(kAttribute); at != std::string::npos;
       at = element.find(kAttribute, at + 1)) {
    const std::size_t equals = element.find_first_not_of(kSpace, at + kAttribute.size());
    if (equals == std::string::npos || element[equals] != '=') continue;
    const std::size_t digits = element.find_first_not_of(" \t\r\n\"'", equals + 1);
    if (digits == std::string::npos) return std::nullopt;
    const double unit = std::strtod(element.c_str() + digits, nullptr);
    if (std::isfinite(unit) && unit > 0) return unit;
    return std::nullopt;
  }
  return std::nullopt;
}

// assimp multiplies by the unit of a Collada file without reporting it. Without a <unit> the unit
// is a metre, without an <up_axis> it is Y (Collada 1.4.1, <asset>).
FileFrame collada_frame(const std::string& text) {
  FileFrame frame{1.0, UpAxis::y};
  if (const auto unit = collada_unit(text)) frame.unit = frame.unit_applied = *unit;
  constexpr std::string_view kUp = "<up_axis>";
  const std::size_t at = text.find(kUp);
  if (at != text.npos) {
    const std::size_t letter = text.find_first_of("XYZ", at + kUp.size());
    if (letter != text.npos) frame.up = static_cast<UpAxis>(text[letter] - 'X');
  }
  return frame;
}

FileFrame fbx_frame(const aiScene& scene) {
  FileFrame frame;
  if (scene.mMetaData == nullptr) return frame;
  double scale = 0;
  float single_scale = 0;
  if (scene.mMetaData->Get("UnitScaleFactor", scale) && scale > 0)
    frame.unit = scale * kFbxUnit;
  else if (scene.mMetaData->Get("UnitScaleFactor", single_scale) && single_scale > 0)
    frame.unit = single_scale * kFbxUnit;
  std::int32_t axis = 0;
  std::int32_t sign = 1;
  if (scene.mMetaData->Get("UpAxis", axis) && axis >= 0 && axis < 3)
    frame.up = static_cast<UpAxis>(axis);
  if (scene.mMetaData->Get("UpAxisSign", sign)) frame.up_reversed = sign < 0;
  return frame;
}

FileFrame frame_of(const std::string& format, const aiScene& scene, const std::string& bytes) {
  if (format == "Collada") return collada_frame(bytes);
  if (format == "FBX") return fbx_frame(scene);
  if (format == "glTF") return {1.0, UpAxis::y};  // by its specification
  return {};
}

// Rotation from the up axis to z.
Mat3 turn_up(UpAxis up, bool reversed) {
  Mat3 turn = Mat3::Identity();
  if (up == UpAxis::x) turn << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  if (up == UpAxis::y) turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  if (reversed) turn = Vec3(1, -1, -1).asDiagonal() * turn;
  return turn;
}

// ---------------------------------------------------------------- scene to parts

Eigen::Affine3d affine(const aiMatrix4x4& m) {
  Eigen::Affine3d t = Eigen::Affine3d::Identity();
  t.matrix() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, 0, 0, 0, 1;
  return t;
}

// Names that assimp generates for unnamed objects.
bool is_placeholder(std::string_view name) {
  return name.empty() || name.front() == '<' || name == "defaultobject" ||
         name == "DefaultMaterial" || name.starts_with("nodes[") || name.starts_with("meshes[");
}

std::string material_name(const aiScene& scene, const aiMesh& mesh) {
  aiString name;
  if (mesh.mMaterialIndex >= scene.mNumMaterials ||
      scene.mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_NAME, name) != aiReturn_SUCCESS)
    return {};
  return is_placeholder(name.C_Str()) ? std::string() : name.C_Str();
}

struct PlacedMesh {
  const aiMesh* mesh = nullptr;
  Eigen::Affine3d to_world;
  std::string name;
  std::string material;
};

// All meshes of the scene, in the order of the node tree. The meshes of an unnamed node get one
// common name, because together they may form a solid.
std::vector<PlacedMesh> placed_meshes(const aiScene& scene, const Eigen::Affine3d& to_meters) {
  struct Visit {
    const aiNode* node;
    Eigen::Affine3d to_world;
  };
  std::vector<PlacedMesh> placed;
  std::size_t objects = 0;
  std::vector<Visit> stack{{scene.mRootNode, to_meters}};
  while (!stack.empty()) {
    const auto [node, parent] = stack.back();
    stack.pop_back();
    const Eigen::Affine3d to_world = parent * affine(node->mTransformation);
    if (node->mNumMeshes > 0) ++objects;
    for (unsigned m = 0; m < node->mNumMeshes; ++m) {
      const aiMesh& mesh = *scene.mMeshes[node->mMeshes[m]];
      std::string name = node->mName.C_Str();
      if (is_placeholder(name)) name = mesh.mName.C_Str();
      if (is_placeholder(name)) name = fmt::format("part_{}", objects);
      placed.push_back({&mesh, to_world, std::move(name), material_name(scene, mesh)});
    }
    for (unsigned c = node->mNumChildren; c-- > 0;) stack.push_back({node->mChildren[c], to_world});
  }
  return placed;
}

// Groups the meshes by name and then material, both in the order of first appearance. One part of
// the result has one name and one material.
std::vector<std::vector<PlacedMesh>> by_part(std::vector<PlacedMesh> placed) {
  std::map<std::string, std::size_t> name_rank;
  std::map<std::pair<std::size_t, std::string>, std::size_t> part_rank;
  for (const PlacedMesh& p : placed) name_rank.try_emplace(p.name, name_rank.size());
  const auto key = [&](const PlacedMesh& p) { return std::pair(name_rank[p.name], p.material); };
  for (const PlacedMesh& p : placed) part_rank.try_emplace(key(p), part_rank.size());
  const auto order = [&](const PlacedMesh& p) {
    return std::pair(name_rank[p.name], part_rank[key(p)]);
  };
  std::stable_sort(placed.begin(), placed.end(),
                   [&](const PlacedMesh& l, const PlacedMesh& r) { return order(l) < order(r); });
  std::vector<std::vector<PlacedMesh>> parts;
  for (PlacedMesh& p : placed) {
    if (parts.empty() || key(parts.back().front()) != key(p)) parts.emplace_back();
    parts.back().push_back(std::move(p));
  }
  return parts;
}

struct PositionHash {
  std::size_t operator()(const std::array<double, 3>& p) const {
    std::size_t hash = 0;
    for (const double x : p) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &x, sizeof bits);
      // Multiply and fold; the constant is 2^64 over the golden ratio. Neighbouring coordinates
      // differ in few bits, which this spreads.
      hash = (hash ^ bits) * 0x9E3779B97F4A7C15U;
      hash ^= hash >> 32U;
    }
    return hash;
  }
};

class MeshBuilder {
 public:
  void begin_part(const PlacedMesh& first) {
    mesh_.parts.push_back({first.name, first.material, triangle_count(), 0});
  }

  void add(const PlacedMesh& placed) {
    const aiMesh& mesh = *placed.mesh;
    std::vector<std::uint32_t> welded(mesh.mNumVertices);
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) welded[v] = vertex(placed, v);
    // A reflection reverses the orientation of faces.
    const bool mirrored = placed.to_world.linear().determinant() < 0;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;  // points and lines
      for (unsigned i = 0; i < 3; ++i)
        if (face.mIndices[i] >= mesh.mNumVertices)
          throw IoError(
              fmt::format("part \"{}\": face {} refers to vertex {} of {}; the file is damaged",
                          placed.name, f, face.mIndices[i], mesh.mNumVertices));
      Triangle t{welded[face.mIndices[0]], welded[face.mIndices[1]], welded[face.mIndices[2]]};
      if (mirrored) std::swap(t[1], t[2]);
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh_.triangles.push_back(t);
    }
  }

  void end_part() {
    MeshPart& part = mesh_.parts.back();
    part.triangle_count = triangle_count() - part.first_triangle;
    if (part.triangle_count == 0) mesh_.parts.pop_back();
  }

  /// Vertices of no triangle would enlarge the bounding box; they are left out.
  TriangleMesh take(std::uint64_t& stray_vertices) {
    std::vector<std::uint32_t> number(mesh_.positions.size(), 0);
    for (const Triangle& t : mesh_.triangles)
      for (const std::uint32_t v : t) number[v] = 1;
    std::uint32_t kept = 0;
    for (std::size_t v = 0; v < number.size(); ++v) {
      if (number[v] == 0) continue;
      mesh_.positions[kept] = mesh_.positions[v];
      number[v] = kept++;
    }
    stray_vertices = number.size() - kept;
    mesh_.positions.resize(kept);
    for (Triangle& t : mesh_.triangles)
      for (std::uint32_t& v : t) v = number[v];
    return std::move(mesh_);
  }

 private:
  std::uint32_t triangle_count() const {
    return static_cast<std::uint32_t>(mesh_.triangles.size());
  }

  std::uint32_t vertex(const PlacedMesh& placed, unsigned v) {
    const aiVector3D& q = placed.mesh->mVertices[v];
    // Adding zero turns -0 into 0.
    const Vec3 p = placed.to_world * Vec3(q.x, q.y, q.z) + Vec3::Zero();
    if (!p.allFinite())
      throw InputError(fmt::format(
          "part \"{}\": vertex {} is not finite; repair the mesh in the program that made it",
          placed.name, v));
    const auto [at, is_new] = welded_.try_emplace(
        {p.x(), p.y(), p.z()}, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (is_new) mesh_.positions.push_back(p);
    return at->second;
  }

  TriangleMesh mesh_;
  std::unordered_map<std::array<double, 3>, std::uint32_t, PositionHash> welded_;
};

// The reason that assimp states, as part of a sentence: without a stop at its end, and without the
// two spaces around an empty name.
std::string reason_of(const Assimp::Importer& importer) {
  std::string reason;
  for (const char* c = importer.GetErrorString(); *c != '\0'; ++c) {
    const bool space = std::isspace(static_cast<unsigned char>(*c)) != 0;
    if (!space)
      reason += *c;
    else if (!reason.empty() && reason.back() != ' ')
      reason += ' ';
  }
  while (!reason.empty() && (reason.back() == '.' || reason.back() == ' ')) reason.pop_back();
  return reason.empty() ? "its reader states no reason" : reason;
}

const aiScene& read_scene(Assimp::Importer& importer, const fs::path& path) {
  // The up axis is rotated here: the caller may override that of the file.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, false);
  const aiScene* scene =
      importer.ReadFile(path.string(), aiProcess_Triangulate | aiProcess_ValidateDataStructure);
  if (scene == nullptr || scene->mRootNode == nullptr)
    throw IoError(
        fmt::format("cannot read {} as a mesh: {}; check that the file is complete and of one of "
                    "the formats {}",
                    path.string(), reason_of(importer), known_formats()));
  return *scene;
}

// assimp looks for the end of a header for ever if there is none.
void require_header(const fs::path& path, const std::string& format, const std::string& bytes) {
  if (format == "PLY" && bytes.find("end_header") == std::string::npos)
    throw IoError(
        fmt::format("cannot read {} as a mesh: its header has no \"end_header\"; check that "
                    "the file is complete",
                    path.string()));
}

}  // namespace

std::vector<std::string> mesh_endings() {
  std::vector<std::string> endings;
  for (const Format& format : kFormats) endings.emplace_back(format.ending);
  return endings;
}

ImportedMesh read_mesh(const fs::path& path, const ImportOptions& options) {
  ImportedMesh result;
  ImportReport& report = result.report;
  const std::string bytes = read_file(path);
  report.format = format_of(path);
  if (bytes.empty())
    throw IoError(fmt::format("{} is empty; springlod reads {}", path.string(), known_formats()));
  report.content_hash = content_hash(bytes);
  require_header(path, report.format, bytes);

  Assimp::Importer importer;
  const aiScene& scene = read_scene(importer, path);
  const FileFrame frame = frame_of(report.format, scene, bytes);
  report.unit = options.unit.value_or(frame.unit.value_or(1));
  report.unit_assumed = !options.unit && !frame.unit;
  report.up = options.up.value_or(frame.up.value_or(UpAxis::z));
  report.up_assumed = !options.up && !frame.up;

  Eigen::Affine3d to_meters = Eigen::Affine3d::Identity();
  to_meters.linear() =
      report.unit / frame.unit_applied * turn_up(report.up, frame.up_reversed && !options.up);
  MeshBuilder builder;
  for (const std::vector<PlacedMesh>& part : by_part(placed_meshes(scene, to_meters))) {
    builder.begin_part(part.front());
    for (const PlacedMesh& placed : part) builder.add(placed);
    builder.end_part();
  }
  result.mesh = builder.take(report.stray_vertices);
  if (result.mesh.triangles.empty())
    throw InputError(
        fmt::format("{} has no triangles; springlod needs a closed surface", path.string()));
  return result;
}

}  // namespace springlod::voxelize
