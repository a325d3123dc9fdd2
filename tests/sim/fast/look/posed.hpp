#pragma once

// Bodies of all fast layouts at any positions, and plain loops over the model to compare with.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "lod/build.hpp"
#include "sim/fast/fast_model.hpp"
#include "tests/sim/side_by_side.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/models.hpp"
#include "voxelize/random/random.hpp"

namespace springlod::test {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
struct Subject {
  MassSpringModel model;
  sim::Layout layout = sim::Layout::fastest;
  std::uint32_t blocks = 1;  // at least
};

inline MassSpringModel merged_block(int side) {
  return lod::simplify(two_material_block(side), {.levels = 1}).levels[1].model;
}

inline MassSpringModel random_body() {
  voxelize::MaterialGrid grid;
  grid.cell = 0.01;
  grid.materials = {Material{.name = "stuff"}};
  for (int z = 0; z < 8; ++z)
    for (int y = 0; y < 7; ++y)
      for (int x = 0; x < 9; ++x) grid.cells.push_back({x, y, z});
  grid.material.assign(grid.cells.size(), 0);
  return voxelize::build_random(grid, {.nodes = 500, .rescale = false}).model;
}

inline const std::map<std::string, Subject>& subjects() {
  static const std::map<std::string, Subject> all{
      {"corners", {two_material_block(21), sim::Layout::fastest, 2}},
      {"centers", {block(22, 21, 20, voxelize::LatticeStyle::centers), sim::Layout::fastest, 2}},
      {"small lattice", {two_material_block(5)}},
      {"lattice in quads", {two_material_block(17), sim::Layout::any_shape, 2}},
      {"merged", {merged_block(25), sim::Layout::fastest, 2}},
      {"small merged", {merged_block(7)}},
      {"random", {random_body()}}};
  return all;
}

/// A body at given positions, in a frame that is not that of the model.
struct Posed {
  Posed(const Subject& subject, sim::Precision precision, const std::vector<Vec3>& x)
      : Posed(subject, precision, x, std::vector<Vec3>(x.size(), Vec3::Zero())) {}
  Posed(const Subject& subject, sim::Precision precision, const std::vector<Vec3>& x,
        const std::vector<Vec3>& v)
      : model(sim::make_fast_model(subject.model, precision, subject.layout)),
        body(model->new_body(false)) {
    frame.origin = bounds(subject.model.rest).center();
    for (std::uint32_t b = 0; b < body->block_count(); ++b) body->set(b, frame, x, v);
  }

  void move_to(const std::vector<Vec3>& x) const {
    const std::vector<Vec3> v(x.size(), Vec3::Zero());
    for (std::uint32_t b = 0; b < body->block_count(); ++b) body->set(b, frame, x, v);
  }

  struct Found {
    std::vector<std::uint32_t> corners;
    double due = kInfinity;
  };
  Found find_corners(double travel = 0) const {
    const sim::CornerLook look{.travel = travel, .farthest = body->farthest_coordinate()};
    Found found;
    for (std::uint32_t b = 0; b < body->block_count(); ++b)
      found.due = std::min(found.due, body->find_corners(b, look, found.corners));
    return found;
  }
  double largest_strain() const {
    double most = 0;
    for (std::uint32_t b = 0; b < body->block_count(); ++b) {
      const double strain = body->largest_strain(b);
      if (std::isnan(strain)) return strain;
      most = std::max(most, strain);
    }
    return most;
  }

  sim::MovingFrame frame;
  std::unique_ptr<sim::FastModel> model;
  std::unique_ptr<sim::FastBody> body;
};

inline double mean_length(const MassSpringModel& model) {
  double sum = 0;
  for (const double length : model.rest_length) sum += length;
  return sum / model.spring_count();
}

inline Vec3 random_vector(std::mt19937_64& random) {
  const Vec3 v(uniform(random), uniform(random), uniform(random));
  return 2 * v - Vec3::Ones();
}

/// Displaced at random by up to `size` mean spring lengths along each axis.
inline std::vector<Vec3> displaced(const MassSpringModel& model, double size,
                                   std::mt19937_64& random) {
  std::vector<Vec3> x = model.rest;
  const double length = mean_length(model);
  for (Vec3& each : x) each += size * length * random_vector(random);
  return x;
}

inline double plain_strain(const MassSpringModel& model, const std::vector<Vec3>& x) {
  double most = 0;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    most =
        std::max(most, std::abs((x[model.b[s]] - x[model.a[s]]).norm() / model.rest_length[s] - 1));
  return most;
}

}  // namespace springlod::test
