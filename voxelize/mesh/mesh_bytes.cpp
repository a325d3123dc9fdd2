#include "voxelize/mesh/mesh_bytes.hpp"

#include "model/packed.hpp"

namespace springlod::voxelize {
namespace {

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
  to.add(mesh.triangles);
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
  mesh.triangles = from.take_list<Triangle>();
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
