#include "voxelize/cells/inside.hpp"

#include <cstddef>
#include <functional>
#include <mutex>

#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <openvdb/tools/TopologyToLevelSet.h>
#include <openvdb/tools/ValueTransformer.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "voxelize/cells/distance_field.hpp"

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
  /// Only counts cells if `owner` is null.
  Claim(const CellFrame& frame, std::uint16_t claimant, std::vector<std::uint16_t>* owner)
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
        std::uint16_t* row =
            owner_ == nullptr ? nullptr : owner_->data() + frame_.number({0, c.y(), c.z()});
        for (c.x() = box.min().x(); c.x() <= box.max().x(); ++c.x()) {
          if (!inside(c)) continue;
          ++count;
          if (row != nullptr && row[c.x()] == 0) row[c.x()] = claimant_;
        }
      }
    return count;
  }

  const CellFrame& frame_;
  openvdb::CoordBBox box_;
  float limit_;
  std::uint16_t claimant_;
  std::vector<std::uint16_t>* owner_;
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

std::size_t claim_all(const DistanceField& field, const Claim& claim) {
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

std::shared_ptr<DistanceField> level_set(const std::vector<Vec3>& positions,
                                         const std::vector<Triangle>& triangles,
                                         const CellFrame& frame,
                                         const std::function<bool(const CellIndex&)>& inside) {
  start_openvdb();
  const openvdb::FloatGrid::Ptr grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
      SurfaceInCells{positions, triangles}, *transform_of(frame), kBand, kBand,
      openvdb::tools::UNSIGNED_DISTANCE_FIELD);
  openvdb::tools::foreach (grid->beginValueOn(), [&](const openvdb::FloatGrid::ValueOnIter& value) {
    const openvdb::Coord c = value.getCoord();
    if (inside({c.x(), c.y(), c.z()})) value.setValue(-*value);
  });
  openvdb::tools::signedFloodFill(grid->tree());
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  return std::make_shared<DistanceField>(grid);
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

std::size_t claim_cells(const DistanceField& field, const CellFrame& frame, std::uint16_t claimant,
                        std::vector<std::uint16_t>& owner) {
  return claim_all(field, Claim(frame, claimant, &owner));
}

std::size_t count_cells(const DistanceField& field, const CellFrame& frame) {
  return claim_all(field, Claim(frame, 0, nullptr));
}

std::vector<CellIndex> cells_inside(const DistanceField& field, const CellFrame& frame) {
  std::vector<std::uint16_t> inside(frame.count(), 0);
  claim_cells(field, frame, 1, inside);
  std::vector<CellIndex> cells;
  for (std::uint32_t n = 0; n < inside.size(); ++n)
    if (inside[n] != 0) cells.push_back(frame.index(n));
  return cells;
}

double distance_at(const DistanceField& field, const CellIndex& cell) {
  return field.grid->tree().getValue(coord(cell));
}

double distance_at(const DistanceField& field, const Vec3& place) {
  return openvdb::tools::BoxSampler::sample(field.grid->tree(),
                                            openvdb::Vec3d(place.x(), place.y(), place.z()));
}

}  // namespace springlod::voxelize
