#include "voxelize/cells/fractions.hpp"

#include <algorithm>
#include <cmath>

#include <openvdb/openvdb.h>
#include <tbb/parallel_for.h>

#include "voxelize/cells/distance_field.hpp"

namespace springlod::voxelize {
namespace {

using Distances = openvdb::FloatGrid::ConstAccessor;

// Half of the diagonal of a cube [edges]: planes farther from its centre do not cut it.
constexpr double kHalfDiagonal = 0.8660254037844386;

// Length of the gradient of a distance, which is 1 but for edges [1].
constexpr double kSmooth = 0.9;

// Fraction of a half cell that is inside [1].
double fraction_inside(const Distances& distances, const openvdb::Coord& at, double edge) {
  const double distance = distances.getValue(at) / edge;
  if (distance >= kHalfDiagonal) return 0;
  if (distance <= -kHalfDiagonal) return 1;
  Vec3 gradient;
  double laplacian = -6 * distance;
  for (int d = 0; d < 3; ++d) {
    openvdb::Coord step(0);
    step[d] = 1;
    const double above = distances.getValue(at + step) / edge;
    const double below = distances.getValue(at - step) / edge;
    gradient[d] = (above - below) / 2;
    laplacian += above + below;
  }
  const double length = gradient.norm();
  // At an edge no plane is right, but one along the axes keeps the cubes inside a box whole.
  if (length < kSmooth) return std::clamp(0.5 - distance, 0.0, 1.0);
  // The mean distance of the cube, so that the plane cuts off as much as the curved surface.
  return cut_cube(gradient / length, distance + laplacian / 24);
}

}  // namespace

double cut_cube(const Vec3& normal, double distance) {
  // A plane along an axis has no extent along the other ones; this much, of the sum of the three,
  // keeps the quotient below finite.
  constexpr double kLeastShare = 1e-4;
  Vec3 m = normal.cwiseAbs();
  const double sum = m.sum();
  m = (m / sum).cwiseMax(kLeastShare);
  m /= m.sum();
  // The plane at m . x = level, of a cube from 0 to 1.
  const double level = std::clamp(0.5 - distance / sum, 0.0, 1.0);
  const auto below = [&](double at) {
    const auto cube = [](double x) { return x > 0 ? x * x * x : 0; };
    const double corners = cube(at) - cube(at - m[0]) - cube(at - m[1]) - cube(at - m[2]) +
                           cube(at - m[0] - m[1]) + cube(at - m[1] - m[2]) + cube(at - m[2] - m[0]);
    return corners / (6 * m.prod());
  };
  // Of the two sides the smaller one, for the sake of rounding.
  const double part = level <= 0.5 ? below(level) : 1 - below(1 - level);
  return std::clamp(part, 0.0, 1.0);
}

CellFrame halved(const CellFrame& frame) {
  return {frame.cell / 2, frame.origin, {2 * frame.size[0], 2 * frame.size[1], 2 * frame.size[2]}};
}

double add_fractions(const DistanceField& halves, const CellFrame& frame,
                     std::vector<float>& fraction) {
  const double edge = frame.cell / 2;
  // Sums of layers, in order, so that the number of threads does not change the total.
  std::vector<double> of_layer(static_cast<std::size_t>(frame.size[2]), 0);
  tbb::parallel_for(std::int32_t{0}, frame.size[2], [&](std::int32_t z) {
    const Distances distances = halves.grid->getConstAccessor();
    CellIndex c{0, 0, z};
    for (c[1] = 0; c[1] < frame.size[1]; ++c[1])
      for (c[0] = 0; c[0] < frame.size[0]; ++c[0]) {
        double inside = 0;
        for (int corner = 0; corner < 8; ++corner)
          inside += fraction_inside(distances,
                                    {2 * c[0] + (corner & 1), 2 * c[1] + (corner >> 1 & 1),
                                     2 * c[2] + (corner >> 2)},
                                    edge) /
                    8;
        of_layer[static_cast<std::size_t>(z)] += inside;
        fraction[frame.number(c)] += static_cast<float>(inside);
      }
  });
  double sum = 0;
  for (const double layer : of_layer) sum += layer;
  return sum;
}

}  // namespace springlod::voxelize
