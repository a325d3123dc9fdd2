#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/choice.hpp"
#include "base/progress.hpp"
#include "model/mesh.hpp"

namespace springlod::voxelize {

enum class UpAxis { x, y, z };

inline constexpr Choice<UpAxis> kUpAxes[] = {
    {UpAxis::x, "x", "x is up"}, {UpAxis::y, "y", "y is up"}, {UpAxis::z, "z", "z is up"}};
constexpr ChoiceTable<Choice<UpAxis>> choices(UpAxis) {
  return {"up", kUpAxes};
}

struct ImportOptions {
  std::optional<double> unit;    ///< unit of the file [m]; default: that stated by the file, or 1 m
  std::optional<UpAxis> up;      ///< default: stated by the file, or usual for the format
  Progress* progress = nullptr;  ///< may stop the import
};

/// Properties of the file, and which of them were assumed.
struct ImportReport {
  std::string format;         ///< "OBJ", "glTF", ...
  double unit = 1;            ///< unit of the file [m]
  bool unit_assumed = false;  ///< neither given in the options nor stated by the file
  UpAxis up = UpAxis::z;
  bool up_assumed = false;
  std::uint64_t stray_vertices = 0;  ///< left out: no triangle has them
  std::string content_hash;          ///< of the file
};

struct ImportedMesh {
  TriangleMesh mesh;  ///< metres, z up, node transforms applied
  ImportReport report;
};

/// Endings of the mesh files that import_mesh reads: ".obj", ...
std::vector<std::string> mesh_endings();

/// Imports OBJ, STL, PLY, GLB/glTF, FBX, OFF and Collada files through assimp, in a child process:
/// damaged files crash assimp, or make it run for ever. Vertices of equal position are merged.
/// Throws IoError (missing, unreadable, empty, or not a mesh format: the message lists the formats)
/// and InputError (vertices that are not finite, no triangles, a crash of assimp, or more time or
/// memory than a file of this size needs).
ImportedMesh import_mesh(const std::filesystem::path& path, const ImportOptions& options = {});

/// Describes unit and up axis, one line each: "assumed 1 unit = 1 m (OBJ does not state it; the
/// option unit changes it)".
std::string describe(const ImportReport& report);

}  // namespace springlod::voxelize
