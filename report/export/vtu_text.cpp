#include "report/export/vtu_text.hpp"

#include <bit>
#include <iterator>

#include <fmt/format.h>

namespace springlod::report {

namespace {

static_assert(std::endian::native == std::endian::little, "the file says LittleEndian");

std::size_t points_of(VtuGrid::Cell cell) {
  switch (cell) {
    case VtuGrid::Cell::line:
      return 2;
    case VtuGrid::Cell::triangle:
      return 3;
    case VtuGrid::Cell::tetrahedron:
      break;
  }
  return 4;
}

// Collects arrays behind the XML, each after its length in bytes.
class Appended {
 public:
  template <class T>
  std::string element(std::string_view name, const char* type, const std::vector<T>& values,
                      int components = 1) {
    const std::size_t offset = bytes_.size();
    const std::uint64_t size = values.size() * sizeof(T);
    bytes_.append(reinterpret_cast<const char*>(&size), sizeof size);
    bytes_.append(reinterpret_cast<const char*>(values.data()), size);
    return fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
        "offset=\"{}\"/>\n",
        type, name, components, offset);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

std::string values_of(const std::vector<VtuGrid::Values>& values, Appended& data) {
  std::string text;
  for (const auto& [name, numbers] : values) text += data.element(name, "Float64", numbers);
  return text;
}

std::string cells_of(const VtuGrid& grid, Appended& data) {
  const std::size_t size = points_of(grid.cell), count = grid.corners.size() / size;
  std::vector<std::int64_t> ends(count);
  for (std::size_t c = 0; c < count; ++c) ends[c] = static_cast<std::int64_t>(size * (c + 1));
  const std::vector<std::uint8_t> types(count, static_cast<std::uint8_t>(grid.cell));
  return data.element("connectivity", "UInt32", grid.corners) +
         data.element("offsets", "Int64", ends) + data.element("types", "UInt8", types);
}

}  // namespace

std::string vtu_text(const VtuGrid& grid, std::string_view origin) {
  Appended data;
  std::vector<double> places;
  places.reserve(3 * grid.points.size());
  for (const Vec3& p : grid.points) places.insert(places.end(), p.data(), p.data() + 3);
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<!-- {} -->\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
      origin, grid.points.size(), grid.corners.size() / points_of(grid.cell));
  text += "<Points>\n" + data.element("position", "Float64", places, 3) + "</Points>\n";
  text += "<Cells>\n" + cells_of(grid, data) + "</Cells>\n";
  text += "<PointData>\n" + values_of(grid.of_points, data) + "</PointData>\n";
  text += "<CellData>\n" + values_of(grid.of_cells, data) + "</CellData>\n";
  text += "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  return text + data.bytes() + "\n</AppendedData>\n</VTKFile>\n";
}

}  // namespace springlod::report
