#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/mesh.hpp"

namespace springlod::voxelize {

/// Generalized winding number of triangles that need not be a closed surface: 1 inside a closed
/// surface that faces outwards, 0 outside, and between the two near holes (Jacobson, Kavan and
/// Sorkine-Hornung 2013, "Robust inside-outside segmentation using generalized winding numbers").
/// Far triangles count together, by the first term of the expansion of Barill et al. 2018, "Fast
/// winding numbers for soups and clouds"; the error is below 0.01.
class WindingNumber {
 public:
  /// Triangles without area do not count.
  WindingNumber(const std::vector<Vec3>& positions, std::span<const Triangle> triangles);
  double at(const Vec3& point) const;  ///< [1]

 private:
  struct Corners {
    Vec3 a, b, c;
  };
  /// A node of the tree. Its children follow it: the first at once, the second at `second`.
  struct Node {
    Vec3 center = Vec3::Zero();  // of its triangles, weighted by their areas
    Vec3 area = Vec3::Zero();    // sum of the vector areas
    double reach = 0;            // largest distance of a corner from the centre
    std::uint32_t first = 0;     // triangle
    std::uint32_t count = 0;     // triangles; 0: not a leaf
    std::uint32_t second = 0;
  };

  void build(std::span<Corners> part);

  std::vector<Corners> triangles_;  // in the order of the leaves
  std::vector<Node> nodes_;
};

}  // namespace springlod::voxelize
