#include "voxelize/inside.hpp"

#include <cstddef>
#include <functional>
#include <mutex>

#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/TopologyToLevelSet.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "voxelize/distance_field.hpp"

namespace springlod::voxelize {
namespace {

// Half width of the narrow band in cells: the smallest that OpenVDB's level set tools support.
constexpr float kBand = 3;
// A centre this close to the surface, in cells, counts as inside: otherwise a plane between two
// parts could leave a gap of cells that belong to neither. Far above the rounding of the level set
// (single precision, distances of a cell or less), far below any visible size.
constexpr double kOnSurface = 1e-4;

openvdb::Coord coord(const CellIndex& c) {
  return {c[0], c[1], c[2]};
}

/// Adapter of a mesh for meshToVolume, which prescribes the names of its members.
// NOLINTBEGIN(readability-identifier-naming)
struct SurfaceInCells {
  const std::vector<Vec3>& positions;
  const std::vector<Triangle>& triangles;

  std::size_t polygonCount() const { return triangles.size(); }
  std::size_t pointCount() const { return positions.size(); }
  std::size_t vertexCount(std::size_t /*polygon*/) const { return 3; }
  void getIndexSpacePoint(std::size_t polygon, std::size_t corner, openvdb::Vec3d& point) const {
    const Vec3& p = positions[triangles[polygon][corner]];
    point = {p.x(), p.y(), p.z()};
  }
};
// NOLINTEND(readability-identifier-naming)

openvdb::math::Transform::Ptr transform_of(const CellFrame& frame) {
  auto transform = openvdb::math::Transform::createLinearTransform(frame.cell);
  const Vec3 first = frame.center({0, 0, 0});
  transform->postTranslate({first.x(), first.y(), first.z()});
  return transform;
}

using Leaf = openvdb::FloatTree::LeafNodeType;

// Assigns cells row by row: x is the innermost index of a frame.
class Claim {
 public:
  Claim(const CellFrame& frame, std::uint16_t claimant, std::vector<std::uint16_t>& owner)
      : frame_(frame),
        box_({0, 0, 0}, coord(frame.size).offsetBy(-1)),
        limit_(static_cast<float>(kOnSurface * frame.cell)),
        claimant_(claimant),
        owner_(owner) {}

  bool holds(float distance) const { return distance <= limit_; }

  std::size_t claim_box(openvdb::CoordBBox box) const {
    box.intersect(box_);
    return claim_rows(box, [](const openvdb::Coord&) { return true; });
  }
  std::size_t claim_leaf(const Leaf& leaf) const {
    openvdb::CoordBBox box = leaf.getNodeBoundingBox();
    box.intersect(box_);
    const float* distances = leaf.buffer().data();
    return claim_rows(
        box, [&](const openvdb::Coord& c) { return holds(distances[Leaf::coordToOffset(c)]); });
  }

 private:
  template <typename Inside>
  std::size_t claim_rows(const openvdb::CoordBBox& box, Inside inside) const {
    std::size_t count = 0;
    openvdb::Coord c = box.min();
    for (c.z() = box.min().z(); c.z() <= box.max().z(); ++c.z())
      for (c.y() = box.min().y(); c.y() <= box.max().y(); ++c.y()) {
        std::uint16_t* row = owner_.data() + frame_.number({0, c.y(), c.z()});
        for (c.x() = box.min().x(); c.x() <= box.max().x(); ++c.x()) {
          if (!inside(c)) continue;
          ++count;
          if (row[c.x()] == 0) row[c.x()] = claimant_;
        }
      }
    return count;
  }

  const CellFrame& frame_;
  openvdb::CoordBBox box_;
  float limit_;
  std::uint16_t claimant_;
  std::vector<std::uint16_t>& owner_;
};

// The items must not overlap.
template <typename Item, typename Work>
std::size_t sum_over(const std::vector<Item>& items, Work work) {
  using Range = tbb::blocked_range<std::size_t>;
  return tbb::parallel_reduce(
      Range(0, items.size()), std::size_t{0},
      [&](const Range& range, std::size_t sum) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) sum += work(items[i]);
        return sum;
      },
      std::plus<>());
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
  return std::make_shared<DistanceField>(openvdb::tools::meshToVolume<openvdb::FloatGrid>(
      SurfaceInCells{positions, triangles}, *transform_of(frame), kBand, kBand));
}

std::shared_ptr<DistanceField> level_set(const std::vector<CellIndex>& cells,
                                         const CellFrame& frame) {
  start_openvdb();
  const auto mask = openvdb::MaskGrid::create();
  mask->setTransform(transform_of(frame));
  auto accessor = mask->getAccessor();
  for (const CellIndex& c : cells) accessor.setValueOn(coord(c));
  return std::make_shared<DistanceField>(
      openvdb::tools::topologyToLevelSet(*mask, static_cast<int>(kBand), 0, 0, 0));
}

void unite(DistanceField& a, DistanceField& b) {
  openvdb::tools::csgUnion(*a.grid, *b.grid);
}

void subtract(DistanceField& a, DistanceField& b) {
  openvdb::tools::csgDifference(*a.grid, *b.grid);
}

std::size_t claim_cells(const DistanceField& field, const CellFrame& frame, std::uint16_t claimant,
                        std::vector<std::uint16_t>& owner) {
  const Claim claim(frame, claimant, owner);
  const openvdb::FloatTree& tree = field.grid->tree();
  std::vector<const Leaf*> leaves;
  tree.getNodes(leaves);
  // Values deeper than the band are in inactive tiles with one negative value.
  std::vector<openvdb::CoordBBox> boxes;
  auto tile = tree.cbeginValueAll();
  tile.setMaxDepth(openvdb::FloatTree::ValueAllCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile)
    if (claim.holds(*tile)) boxes.push_back(tile.getBoundingBox());
  return sum_over(leaves, [&](const Leaf* leaf) { return claim.claim_leaf(*leaf); }) +
         sum_over(boxes, [&](const openvdb::CoordBBox& box) { return claim.claim_box(box); });
}

}  // namespace springlod::voxelize
