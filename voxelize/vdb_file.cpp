#include "voxelize/vdb_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string_view>

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/TopologyToLevelSet.h>

#include "base/child_work.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/message.hpp"
#include "voxelize/cells/distance_field.hpp"
#include "voxelize/index_lookup.hpp"
#include "voxelize/vdb_surface.hpp"

namespace springlod::voxelize {
namespace {

namespace fs = std::filesystem;

// Version of the metadata below; it grows when their meaning changes. A file has the first version
// that knows all that is in it, so that programs that do not know that do not read it.
constexpr std::int32_t kFileVersion = 3;
constexpr std::int32_t kWithCutCells = 3;
constexpr std::int32_t kWithPoisson = 2;
constexpr std::int32_t kFirstVersion = 1;
constexpr const char* kVersion = "springlod_version";
constexpr const char* kCell = "springlod_cell";
constexpr const char* kOrigin = "springlod_origin";
constexpr const char* kMaterialCount = "springlod_material_count";
constexpr const char* kHasDistance = "springlod_has_distance";

// Some messages of OpenVDB hold what it found in the file, of any length [characters].
constexpr std::size_t kLongestReason = 300;

// Processor time for the trial in a child process: files of ours take 0.12 s for each MB, many
// damaged ones never end.
constexpr double kLeastSeconds = 2;
constexpr double kSecondsPerByte = 1e-6;

constexpr std::int32_t kOutside = -1;  // in the grid "material"
constexpr int kBand = 3;  // half width of a level set in cells, the default of OpenVDB's tools

std::string material_key(std::size_t n, const char* field) {
  return fmt::format("springlod_material_{}_{}", n, field);
}

openvdb::math::Transform::Ptr transform_of(const MaterialGrid& grid) {
  const Vec3 first = grid.origin + Vec3::Constant(grid.cell / 2);
  auto transform = openvdb::math::Transform::createLinearTransform(grid.cell);
  transform->postTranslate({first.x(), first.y(), first.z()});
  return transform;
}

template <typename Grid, typename Value>
typename Grid::Ptr cell_grid(const MaterialGrid& grid, const char* name,
                             typename Grid::ValueType background, Value value_of) {
  auto out = Grid::create(background);
  out->setName(name);
  out->setTransform(transform_of(grid));
  auto accessor = out->getAccessor();
  for (std::size_t n = 0; n < grid.cells.size(); ++n) {
    const CellIndex& c = grid.cells[n];
    accessor.setValueOn({c[0], c[1], c[2]}, static_cast<typename Grid::ValueType>(value_of(n)));
  }
  return out;
}

std::int32_t version_of(const MaterialGrid& grid) {
  if (!grid.fraction.empty()) return kWithCutCells;
  const bool has_poisson =
      std::any_of(grid.materials.begin(), grid.materials.end(),
                  [](const Material& m) { return m.poisson != kSpringPoisson; });
  return has_poisson ? kWithPoisson : kFirstVersion;
}

openvdb::MetaMap metadata_of(const MaterialGrid& grid) {
  openvdb::MetaMap meta;
  meta.insertMeta(kVersion, openvdb::Int32Metadata(version_of(grid)));
  meta.insertMeta(kCell, openvdb::DoubleMetadata(grid.cell));
  meta.insertMeta(kOrigin,
                  openvdb::Vec3DMetadata({grid.origin.x(), grid.origin.y(), grid.origin.z()}));
  meta.insertMeta(kHasDistance, openvdb::BoolMetadata(grid.distance != nullptr));
  meta.insertMeta(kMaterialCount,
                  openvdb::Int32Metadata(static_cast<std::int32_t>(grid.materials.size())));
  for (std::size_t n = 0; n < grid.materials.size(); ++n) {
    const Material& m = grid.materials[n];
    meta.insertMeta(material_key(n, "name"), openvdb::StringMetadata(m.name));
    meta.insertMeta(material_key(n, "young"), openvdb::DoubleMetadata(m.young));
    meta.insertMeta(material_key(n, "density"), openvdb::DoubleMetadata(m.density));
    meta.insertMeta(material_key(n, "damping"), openvdb::DoubleMetadata(m.damping));
    meta.insertMeta(material_key(n, "colour"),
                    openvdb::Vec3SMetadata({m.colour.r, m.colour.g, m.colour.b}));
    if (m.poisson != kSpringPoisson)
      meta.insertMeta(material_key(n, "poisson"), openvdb::DoubleMetadata(m.poisson));
  }
  return meta;
}

openvdb::GridCPtrVec grids_of(const MaterialGrid& grid) {
  const auto material = cell_grid<openvdb::Int32Grid>(grid, "material", kOutside,
                                                      [&](auto n) { return grid.material[n]; });
  openvdb::FloatGrid::Ptr distance =
      grid.distance != nullptr ? grid.distance->grid->deepCopy()
                               : openvdb::tools::topologyToLevelSet(*material, kBand, 0, 0, 0);
  distance->setName("distance");
  distance->setGridClass(openvdb::GRID_LEVEL_SET);
  openvdb::GridCPtrVec grids{distance, material};
  const auto add = [&](const char* name, auto value_of) {
    grids.push_back(cell_grid<openvdb::FloatGrid>(grid, name, 0, value_of));
  };
  add("young", [&](auto n) { return grid.materials[grid.material[n]].young; });
  add("density", [&](auto n) { return grid.materials[grid.material[n]].density; });
  if (!grid.depth.empty()) add("depth", [&](auto n) { return grid.depth[n]; });
  if (!grid.fraction.empty()) add("fraction", [&](auto n) { return grid.fraction[n]; });
  if (!grid.surface.empty()) {
    const auto surface = vdb_of_surface(grid, *transform_of(grid));
    surface->setName("surface");
    grids.push_back(surface);
  }
  return grids;
}

// The last line of a file: the hash of all bytes before it. Other programs ignore it, because grids
// are found by their offsets. A file that another program has written again has none.
constexpr std::string_view kHashLabel = "\nspringlod content hash ";
constexpr std::size_t kHashDigits = 16;
constexpr std::size_t kHashLine = kHashLabel.size() + kHashDigits;

void append_hash(const fs::path& aside, const fs::path& path) {
  const std::string hash = content_hash(read_file(aside));
  std::ofstream out(aside, std::ios::binary | std::ios::app);
  out << kHashLabel << hash;
  out.close();
  if (!out) throw IoError(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
}

// Returns the number of bytes of the file, which has no wrong hash.
std::size_t intact_size(const fs::path& path) {
  const std::string bytes = read_file(path);
  std::int64_t magic = 0;
  std::memcpy(&magic, bytes.data(), std::min(bytes.size(), sizeof magic));
  if (magic != openvdb::OPENVDB_MAGIC)
    throw IoError(fmt::format("{} is not a .vdb file", path.string()));
  if (bytes.size() < kHashLine) return bytes.size();
  const std::string_view all = bytes;
  const std::string_view line = all.substr(bytes.size() - kHashLine);
  if (line.starts_with(kHashLabel) &&
      line.substr(kHashLabel.size()) != content_hash(all.substr(0, bytes.size() - kHashLine)))
    throw IoError(
        fmt::format("{} is damaged: its content does not have the hash that it states; make or "
                    "copy it again",
                    path.string()));
  return bytes.size();
}

class Reader {
 public:
  explicit Reader(const fs::path& path) : path_(path), file_(path.string()) {}

  MaterialGrid read() {
    file_.open(/*delayLoad=*/false);
    meta_ = file_.getMetadata();
    require_ours();
    MaterialGrid grid;
    grid.cell = value<double>(kCell);
    const auto origin = value<openvdb::Vec3d>(kOrigin);
    grid.origin = {origin.x(), origin.y(), origin.z()};
    read_materials(grid);
    read_cells(grid);
    if (file_.hasGrid("depth")) grid.depth = read_numbers("depth", grid.cells);
    if (file_.hasGrid("fraction")) grid.fraction = read_numbers("fraction", grid.cells);
    if (file_.hasGrid("surface")) grid.surface = surface_of_vdb(*file_.readGrid("surface"), grid);
    if (value<bool>(kHasDistance))
      grid.distance = std::make_shared<DistanceField>(read_grid<openvdb::FloatGrid>("distance"));
    validate(grid);
    return grid;
  }

 private:
  template <typename T>
  T value(const std::string& key) const {
    return meta_->metaValue<T>(key);
  }

  template <typename Grid>
  typename Grid::Ptr read_grid(const char* name) {
    auto grid = openvdb::gridPtrCast<Grid>(file_.readGrid(name));
    if (grid == nullptr)
      throw IoError(
          fmt::format("{}: the type of its grid \"{}\" is not the one that springlod writes",
                      path_.string(), name));
    return grid;
  }

  void require_ours() const {
    if ((*meta_)[kVersion] == nullptr || !file_.hasGrid("material"))
      throw IoError(
          fmt::format("{} is a .vdb file, but not one that springlod wrote: it has no \"material\" "
                      "grid with springlod's metadata",
                      path_.string()));
    const auto version = value<std::int32_t>(kVersion);
    if (version > kFileVersion)
      throw IoError(fmt::format(
          "{} has format version {}; this springlod reads versions up to {}; update springlod",
          path_.string(), version, kFileVersion));
  }

  void read_materials(MaterialGrid& grid) const {
    const auto count =
        static_cast<std::size_t>(std::max<std::int32_t>(0, value<std::int32_t>(kMaterialCount)));
    for (std::size_t n = 0; n < count; ++n) {
      Material m;
      m.name = value<std::string>(material_key(n, "name"));
      m.young = value<double>(material_key(n, "young"));
      m.density = value<double>(material_key(n, "density"));
      m.damping = value<double>(material_key(n, "damping"));
      const auto colour = value<openvdb::Vec3s>(material_key(n, "colour"));
      m.colour = {colour.x(), colour.y(), colour.z()};
      const std::string poisson = material_key(n, "poisson");
      if ((*meta_)[poisson] != nullptr) m.poisson = value<double>(poisson);
      grid.materials.push_back(m);
    }
  }

  void read_cells(MaterialGrid& grid) {
    const auto numbers = read_grid<openvdb::Int32Grid>("material");
    std::vector<std::pair<CellIndex, std::uint16_t>> cells;
    // A tile represents all cells of its box.
    for (auto at = numbers->cbeginValueOn(); at; ++at) {
      if (*at < 0 || static_cast<std::size_t>(*at) >= grid.materials.size())
        throw IoError(fmt::format("{}: a cell has material {} of {}; the file is damaged",
                                  path_.string(), *at, grid.materials.size()));
      const openvdb::CoordBBox box = at.getBoundingBox();
      for (auto c = box.begin(); c; ++c)
        cells.push_back({{(*c).x(), (*c).y(), (*c).z()}, static_cast<std::uint16_t>(*at)});
    }
    std::sort(cells.begin(), cells.end(),
              [](const auto& l, const auto& r) { return grid_order(l.first, r.first); });
    for (const auto& [cell, material] : cells) {
      grid.cells.push_back(cell);
      grid.material.push_back(material);
    }
  }

  std::vector<float> read_numbers(const char* name, const std::vector<CellIndex>& cells) {
    const auto numbers = read_grid<openvdb::FloatGrid>(name);
    const auto accessor = numbers->getConstAccessor();
    std::vector<float> of_cells;
    of_cells.reserve(cells.size());
    for (const CellIndex& c : cells) of_cells.push_back(accessor.getValue({c[0], c[1], c[2]}));
    return of_cells;
  }

  const fs::path& path_;
  openvdb::io::File file_;
  openvdb::MetaMap::Ptr meta_;
};

}  // namespace

void save_vdb(const MaterialGrid& grid, const fs::path& path) {
  validate(grid);
  start_openvdb();
  write_aside(path, [&](const fs::path& aside) {
    try {
      openvdb::io::File file(aside.string());
      const std::uint32_t method = openvdb::io::Archive::hasBloscCompression()
                                       ? openvdb::io::COMPRESS_BLOSC
                                       : openvdb::io::COMPRESS_ZIP;
      file.setCompression(method | openvdb::io::COMPRESS_ACTIVE_MASK);
      file.write(grids_of(grid), metadata_of(grid));
      file.close();
      append_hash(aside, path);
    } catch (const openvdb::Exception& e) {
      throw IoError(fmt::format("cannot write {}: {}", path.string(), e.what()));
    }
  });
}

MaterialGrid load_vdb(const fs::path& path) {
  const auto bytes = static_cast<double>(intact_size(path));
  start_openvdb();
  const auto damaged = [&](std::string_view reason) {
    return IoError(fmt::format("{} is damaged: {}", path.string(),
                               printable(reason.substr(0, kLongestReason))));
  };
  try {
    // What OpenVDB survives there, it survives here.
    run_in_child([&] { return Reader(path).read(), std::string(); },
                 {.seconds = std::ceil(kLeastSeconds + kSecondsPerByte * bytes)});
    return Reader(path).read();
  } catch (const ChildFailure& e) {
    throw damaged(fmt::format("OpenVDB {}", e.what()));
  } catch (const InputError& e) {
    throw damaged(e.what());
  } catch (const openvdb::Exception& e) {
    throw damaged(e.what());
  }
}

}  // namespace springlod::voxelize
