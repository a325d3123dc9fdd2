#include "voxelize/mesh_bytes.hpp"

#include <algorithm>
#include <span>

#include "model/packed.hpp"

namespace springlod::voxelize {
namespace {

constexpr std::size_t kCorners = std::tuple_size_v<Triangle>;

void pack(Packer& to, const ImportReport& report) {
  to.add(report.format);
  to.add(report.unit);
  to.add(report.unit_assumed);
  to.add(static_cast<int>(report.up));
  to.add(report.up_assumed);
  to.add(report.stray_vertices);
  to.add(report.content_hash);
}

void take(Unpacker& from, ImportReport& report) {
  report.format = from.take_text();
  report.unit = from.take<double>();
  report.unit_assumed = from.take<bool>();
  report.up = static_cast<UpAxis>(from.take<int>());
  report.up_assumed = from.take<bool>();
  report.stray_vertices = from.take<std::uint64_t>();
  report.content_hash = from.take_text();
}

void pack(Packer& to, const TriangleMesh& mesh) {
  to.add(mesh.positions);
  to.add(std::span<const std::uint32_t>(mesh.triangles.empty() ? nullptr : mesh.triangles[0].data(),
                                        kCorners * mesh.triangles.size()));
  to.add(std::uint64_t{mesh.parts.size()});
  for (const MeshPart& part : mesh.parts) {
    to.add(part.name);
    to.add(part.material);
    to.add(part.first_triangle);
    to.add(part.triangle_count);
  }
}

void take(Unpacker& from, TriangleMesh& mesh) {
  mesh.positions = from.take_vectors();
  const std::vector<std::uint32_t> corners = from.take_list<std::uint32_t>();
  mesh.triangles.resize(corners.size() / kCorners);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    std::copy_n(corners.begin() + static_cast<std::ptrdiff_t>(kCorners * t), kCorners,
                mesh.triangles[t].begin());
  for (auto left = from.take<std::uint64_t>(); left > 0; --left) {
    MeshPart& part = mesh.parts.emplace_back();
    part.name = from.take_text();
    part.material = from.take_text();
    part.first_triangle = from.take<std::uint32_t>();
    part.triangle_count = from.take<std::uint32_t>();
  }
}

}  // namespace

std::string to_bytes(const ImportedMesh& imported) {
  Packer packer;
  pack(packer, imported.report);
  pack(packer, imported.mesh);
  return packer.bytes();
}

ImportedMesh mesh_from_bytes(std::string_view bytes) {
  Unpacker unpacker(bytes);
  ImportedMesh imported;
  take(unpacker, imported.report);
  take(unpacker, imported.mesh);
  validate(imported.mesh);
  return imported;
}

}  // namespace springlod::voxelize
