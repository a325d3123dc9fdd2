#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/choice.hpp"
#include "model/mesh.hpp"

namespace springlod::voxelize {

enum class UpAxis { x, y, z };

inline constexpr Choice<UpAxis> kUpAxes[] = {
    {UpAxis::x, "x", "x is up"}, {UpAxis::y, "y", "y is up"}, {UpAxis::z, "z", "z is up"}};
constexpr ChoiceTable<Choice<UpAxis>> choices(UpAxis) {
  return {"up", kUpAxes};
}

struct ImportOptions {
  std::optional<double> unit;  ///< metres in one unit of the file; left out: the file's, or metres
  std::optional<UpAxis> up;    ///< left out: the file's, or the format's custom
};

/// What was read and what had to be assumed.
struct ImportReport {
  std::string format;         ///< "OBJ", "glTF", ...
  double unit = 1;            ///< metres in one unit of the file
  bool unit_assumed = false;  ///< neither given nor stated by the file
  UpAxis up = UpAxis::z;
  bool up_assumed = false;
  std::string content_hash;  ///< of the file
};

struct ImportedMesh {
  TriangleMesh mesh;  ///< metres, z up, node transforms applied
  ImportReport report;
};

/// Reads OBJ, STL, PLY, GLB/glTF, FBX, OFF and Collada through assimp. Vertices are welded by
/// position. Throws IoError (missing, unreadable, empty, not a mesh format: the message lists the
/// formats) and InputError (NaN or infinite vertices, no triangles).
ImportedMesh import_mesh(const std::filesystem::path& path, const ImportOptions& options = {});

/// "assumed 1 unit = 1 m (OBJ does not say; the option unit changes it)", ... one line each.
std::string describe(const ImportReport& report);

}  // namespace springlod::voxelize
