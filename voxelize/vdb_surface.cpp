#include "voxelize/vdb_surface.hpp"

#include <utility>

#include <openvdb/points/PointAttribute.h>
#include <openvdb/points/PointConversion.h>
#include <openvdb/points/PointDataGrid.h>
#include <openvdb/tools/PointIndexGrid.h>

#include "base/error.hpp"
#include "voxelize/cells/surface_points.hpp"
#include "voxelize/index_lookup.hpp"

namespace springlod::voxelize {
namespace {

namespace points = openvdb::points;

constexpr const char* kPlace = "P";
constexpr const char* kNormal = "N";
constexpr const char* kArea = "area";

// Adds an attribute with one value for each point of the index.
template <class Value>
void add_attribute(points::PointDataGrid& grid, const openvdb::tools::PointIndexGrid& index,
                   const char* name, const std::vector<Value>& values) {
  points::appendAttribute<Value>(grid.tree(), name);
  const points::PointAttributeVector<Value> wrapped(values);
  points::populateAttribute(grid.tree(), index.tree(), name, wrapped);
}

}  // namespace

openvdb::GridBase::Ptr vdb_of_surface(const MaterialGrid& grid,
                                      const openvdb::math::Transform& transform) {
  std::vector<openvdb::Vec3R> positions;
  std::vector<openvdb::Vec3f> normals;
  std::vector<double> areas;
  for (const SurfacePoint& point : grid.surface) {
    const openvdb::Vec3d at(point.cell[0] + static_cast<double>(point.place[0]),
                            point.cell[1] + static_cast<double>(point.place[1]),
                            point.cell[2] + static_cast<double>(point.place[2]));
    positions.push_back(transform.indexToWorld(at));
    normals.emplace_back(point.normal[0], point.normal[1], point.normal[2]);
    areas.push_back(point.area);
  }
  const points::PointAttributeVector<openvdb::Vec3R> wrapped(positions);
  const auto index =
      openvdb::tools::createPointIndexGrid<openvdb::tools::PointIndexGrid>(wrapped, transform);
  const auto out = points::createPointDataGrid<points::NullCodec, points::PointDataGrid>(
      *index, wrapped, transform);
  add_attribute(*out, *index, kNormal, normals);
  add_attribute(*out, *index, kArea, areas);
  return out;
}

std::vector<SurfacePoint> surface_of_vdb(const openvdb::GridBase& base, const MaterialGrid& grid) {
  const auto* data = dynamic_cast<const points::PointDataGrid*>(&base);
  if (data == nullptr) throw InputError("its surface is not a grid of points");
  const IndexLookup lookup(grid.cells);
  std::vector<SurfacePoint> surface;
  for (auto leaf = data->tree().cbeginLeaf(); leaf; ++leaf) {
    for (const char* name : {kPlace, kNormal, kArea})
      if (!leaf->hasAttribute(name)) throw InputError("the points of its surface lack a value");
    const points::AttributeHandle<openvdb::Vec3f> places(leaf->constAttributeArray(kPlace));
    const points::AttributeHandle<openvdb::Vec3f> normals(leaf->constAttributeArray(kNormal));
    const points::AttributeHandle<double> areas(leaf->constAttributeArray(kArea));
    for (auto i = leaf->beginIndexOn(); i; ++i) {
      const openvdb::Vec3f place = places.get(*i);
      const openvdb::Vec3f normal = normals.get(*i);
      const openvdb::Coord cell = i.getCoord();
      const Vec3 at(cell.x() + 0.5 + place.x(), cell.y() + 0.5 + place.y(),
                    cell.z() + 0.5 + place.z());
      auto point = point_in_cells(lookup, at);
      if (!point) throw InputError("a point of its surface is far outside its cells");
      point->normal = {normal.x(), normal.y(), normal.z()};
      point->area = areas.get(*i);
      surface.push_back(*point);
    }
  }
  sort_points(surface);
  return surface;
}

}  // namespace springlod::voxelize
