#include "voxelize/mesh_bytes.hpp"

#include <cstring>
#include <type_traits>

#include "base/error.hpp"

namespace springlod::voxelize {
namespace {

class Writer {
 public:
  template <class T>
  void value(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void text(const std::string& text) {
    value(std::uint64_t{text.size()});
    bytes_ += text;
  }
  template <class T>
  void list(const std::vector<T>& values) {
    value(std::uint64_t{values.size()});
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  void value(T& into) {
    std::memcpy(&into, next(1, sizeof into).data(), sizeof into);
  }
  void text(std::string& into) { into = next(count(), 1); }
  template <class T>
  void list(std::vector<T>& into) {
    const std::uint64_t size = count();
    const std::string_view part = next(size, sizeof(T));
    into.resize(size);
    std::memcpy(static_cast<void*>(into.data()), part.data(), part.size());
  }
  std::uint64_t count() {
    std::uint64_t size = 0;
    value(size);
    return size;
  }

 private:
  std::string_view next(std::uint64_t number, std::size_t size) {
    if (number > bytes_.size() / size) throw InputError("the imported mesh is not complete");
    const std::string_view part = bytes_.substr(0, number * size);
    bytes_.remove_prefix(part.size());
    return part;
  }

  std::string_view bytes_;
};

// One order of the fields for both ways.
template <class Stream, class Report>
void report_fields(Stream& stream, Report& report) {
  stream.text(report.format);
  stream.value(report.unit);
  stream.value(report.unit_assumed);
  stream.value(report.up);
  stream.value(report.up_assumed);
  stream.value(report.stray_vertices);
  stream.text(report.content_hash);
}

template <class Stream, class Part>
void part_fields(Stream& stream, Part& part) {
  stream.text(part.name);
  stream.text(part.material);
  stream.value(part.first_triangle);
  stream.value(part.triangle_count);
}

}  // namespace

std::string to_bytes(const ImportedMesh& imported) {
  Writer writer;
  report_fields(writer, imported.report);
  writer.list(imported.mesh.positions);
  writer.list(imported.mesh.triangles);
  writer.value(std::uint64_t{imported.mesh.parts.size()});
  for (const MeshPart& part : imported.mesh.parts) part_fields(writer, part);
  return writer.take();
}

ImportedMesh mesh_from_bytes(std::string_view bytes) {
  Reader reader(bytes);
  ImportedMesh imported;
  report_fields(reader, imported.report);
  reader.list(imported.mesh.positions);
  reader.list(imported.mesh.triangles);
  for (std::uint64_t left = reader.count(); left > 0; --left)
    part_fields(reader, imported.mesh.parts.emplace_back());
  validate(imported.mesh);
  return imported;
}

}  // namespace springlod::voxelize
