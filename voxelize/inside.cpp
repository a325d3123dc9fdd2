#include "voxelize/inside.hpp"

#include <mutex>

#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/MeshToVolume.h>

#include "voxelize/distance_field.hpp"

namespace springlod {
namespace {

// Half width of the narrow band in cells: the least that level set tools of OpenVDB expect.
constexpr float kBand = 3;
// A centre this near to the surface, in cells, is on it and counts as inside: else the plane where
// two parts meet would leave a gap of cells that belong to neither. Well above the rounding of the
// level set (single precision, distances of a cell or less), well below anything one would see.
constexpr double kOnSurface = 1e-4;

openvdb::Coord coord(const CellIndex& c) {
  return {c[0], c[1], c[2]};
}

}  // namespace

void start_openvdb() {
  static std::once_flag once;
  std::call_once(once, [] { openvdb::initialize(); });
}

std::shared_ptr<DistanceField> level_set(const std::vector<Vec3>& positions,
                                         const std::vector<Triangle>& triangles,
                                         const CellFrame& frame) {
  start_openvdb();
  std::vector<openvdb::Vec3d> points;
  points.reserve(positions.size());
  for (const Vec3& position : positions) {
    const Vec3 p = frame.to_index(position);
    points.emplace_back(p.x(), p.y(), p.z());
  }
  std::vector<openvdb::Vec3I> faces;
  faces.reserve(triangles.size());
  for (const Triangle& t : triangles) faces.emplace_back(t[0], t[1], t[2]);
  const auto transform = openvdb::math::Transform::createLinearTransform(frame.cell);
  const Vec3 first = frame.center({0, 0, 0});
  transform->postTranslate({first.x(), first.y(), first.z()});
  const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3d, openvdb::Vec3I> mesh(points,
                                                                                        faces);
  return std::make_shared<DistanceField>(
      openvdb::tools::meshToVolume<openvdb::FloatGrid>(mesh, *transform, kBand, kBand));
}

void unite(DistanceField& a, DistanceField& b) {
  openvdb::tools::csgUnion(*a.grid, *b.grid);
}

void subtract(DistanceField& a, DistanceField& b) {
  openvdb::tools::csgDifference(*a.grid, *b.grid);
}

std::vector<std::uint32_t> inside_cells(const DistanceField& field, const CellFrame& frame) {
  const auto limit = static_cast<float>(kOnSurface * frame.cell);
  std::vector<std::uint32_t> inside;
  const openvdb::CoordBBox box({0, 0, 0}, coord(frame.size).offsetBy(-1));
  const openvdb::FloatTree& tree = field.grid->tree();
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf)
    for (auto value = leaf->cbeginValueAll(); value; ++value) {
      if (*value > limit) continue;
      const openvdb::Coord c = value.getCoord();
      if (box.isInside(c)) inside.push_back(frame.number({c.x(), c.y(), c.z()}));
    }
  // What lies deeper than the band is held by tiles of one negative value, not active.
  auto tile = tree.cbeginValueAll();
  tile.setMaxDepth(openvdb::FloatTree::ValueAllCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    if (*tile > limit) continue;
    openvdb::CoordBBox region = tile.getBoundingBox();
    region.intersect(box);
    for (auto c = region.begin(); c; ++c)
      inside.push_back(frame.number({(*c).x(), (*c).y(), (*c).z()}));
  }
  return inside;
}

}  // namespace springlod
