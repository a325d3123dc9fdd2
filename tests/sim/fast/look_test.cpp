// Corners, strains and departures of fast layouts, compared with plain loops over the model.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <set>

#include <catch2/catch.hpp>
#include <hwy/targets.h>

#include "lod/build.hpp"
#include "model/corners.hpp"
#include "sim/fast/fast_model.hpp"
#include "sim/fast/rigid_motion.hpp"
#include "tests/sim/side_by_side.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/models.hpp"
#include "voxelize/random.hpp"

using namespace springlod;
using namespace springlod::sim;
using namespace springlod::test;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Subject {
  MassSpringModel model;
  Layout layout = Layout::fastest;
  std::uint32_t blocks = 1;  // at least
};

MassSpringModel merged_block(int side) {
  return lod::simplify(two_material_block(side), {.levels = 1}).levels[1].model;
}

MassSpringModel random_body() {
  voxelize::MaterialGrid grid;
  grid.cell = 0.01;
  grid.materials = {Material{.name = "stuff"}};
  for (int z = 0; z < 8; ++z)
    for (int y = 0; y < 7; ++y)
      for (int x = 0; x < 9; ++x) grid.cells.push_back({x, y, z});
  grid.material.assign(grid.cells.size(), 0);
  return voxelize::build_random(grid, {.nodes = 500, .rescale = false}).model;
}

const std::map<std::string, Subject>& subjects() {
  static const std::map<std::string, Subject> all{
      {"corners", {two_material_block(21), Layout::fastest, 2}},
      {"centers", {block(22, 21, 20, voxelize::LatticeStyle::centers), Layout::fastest, 2}},
      {"small lattice", {two_material_block(5)}},
      {"lattice in quads", {two_material_block(17), Layout::any_shape, 2}},
      {"merged", {merged_block(25), Layout::fastest, 2}},
      {"small merged", {merged_block(7)}},
      {"random", {random_body()}}};
  return all;
}

/// A body at given positions, in a frame that is not that of the model.
struct Posed {
  Posed(const Subject& subject, Precision precision, const std::vector<Vec3>& x)
      : Posed(subject, precision, x, std::vector<Vec3>(x.size(), Vec3::Zero())) {}
  Posed(const Subject& subject, Precision precision, const std::vector<Vec3>& x,
        const std::vector<Vec3>& v)
      : model(make_fast_model(subject.model, precision, subject.layout)),
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
    const CornerLook look{.travel = travel, .farthest = body->farthest_coordinate()};
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

  MovingFrame frame;
  std::unique_ptr<FastModel> model;
  std::unique_ptr<FastBody> body;
};

double mean_length(const MassSpringModel& model) {
  double sum = 0;
  for (const double length : model.rest_length) sum += length;
  return sum / model.spring_count();
}

Vec3 random_vector(std::mt19937_64& random) {
  const Vec3 v(uniform(random), uniform(random), uniform(random));
  return 2 * v - Vec3::Ones();
}

/// Displaced at random by up to `size` mean spring lengths along each axis.
std::vector<Vec3> displaced(const MassSpringModel& model, double size, std::mt19937_64& random) {
  std::vector<Vec3> x = model.rest;
  const double length = mean_length(model);
  for (Vec3& each : x) each += size * length * random_vector(random);
  return x;
}

double plain_strain(const MassSpringModel& model, const std::vector<Vec3>& x) {
  double most = 0;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    most =
        std::max(most, std::abs((x[model.b[s]] - x[model.a[s]]).norm() / model.rest_length[s] - 1));
  return most;
}

/// Bound on the rounding of margins [m].
double rounding(const MassSpringModel& model, Precision precision) {
  const double size = bounds(model.rest).sizes().maxCoeff();
  return (precision == Precision::single_precision ? 4e-6 : 1e-14) * size;
}

double least_margin(const MassSpringModel& model, const std::vector<Vec3>& x) {
  double least = kInfinity;
  for (const Corner& corner : model.corners)
    least = std::min(least, corner_margin(corner, model.rest, x));
  return least;
}

/// Checks that these are the corners without a margin.
void check_found(const MassSpringModel& model, const std::vector<Vec3>& x,
                 const std::vector<std::uint32_t>& corners, double rounding) {
  const std::set<std::uint32_t> found(corners.begin(), corners.end());
  REQUIRE(found.size() == corners.size());  // none twice
  std::uint32_t missed = 0;
  std::uint32_t needless = 0;
  for (std::uint32_t c = 0; c < model.corner_count(); ++c) {
    const double margin = corner_margin(model.corners[c], model.rest, x);
    if (found.count(c) == 0 && !(margin >= 0)) ++missed;
    if (found.count(c) != 0 && margin > rounding) ++needless;
  }
  CHECK(missed == 0);
  CHECK(needless == 0);
}

/// Every corner turned inside out.
std::vector<Vec3> mirrored(std::vector<Vec3> x) {
  for (Vec3& each : x) each.x() = -each.x();
  return x;
}

}  // namespace

TEST_CASE("Fast layouts find the corners without a margin, and when the next is due") {
  const auto precision = GENERATE(Precision::single_precision, Precision::double_precision);
  std::mt19937_64 random(1);
  for (const auto& [name, subject] : subjects()) {
    const MassSpringModel& model = subject.model;
    REQUIRE(model.corner_count() > 0);
    for (const double size : {0.0, 0.02, 0.4}) {
      CAPTURE(name, precision, size);
      const std::vector<Vec3> x = displaced(model, size, random);
      const Posed posed(subject, precision, x);
      REQUIRE(posed.body->block_count() >= subject.blocks);
      const Posed::Found found = posed.find_corners(1);
      const double near = rounding(model, precision);
      check_found(model, x, found.corners, near);
      const double least = least_margin(model, x);
      if (size > 0.3) {
        REQUIRE(inverted_corners(model.corners, x).size() > 10);
        CHECK(found.due == -kInfinity);
      } else if (found.corners.empty()) {
        CHECK(found.due <= 1 + least);
        // Sharp if the corners of a group have grown alike.
        CHECK(found.due >= 1 + (size == 0 ? 1 : 0.8) * least - near);
      }
      if (size == 0) CHECK(found.corners.empty());
    }
  }
}

TEST_CASE("Only groups of corners that are due are looked at") {
  const auto precision = GENERATE(Precision::single_precision, Precision::double_precision);
  std::mt19937_64 random(7);
  for (const auto& [name, subject] : subjects()) {
    CAPTURE(name, precision);
    const MassSpringModel& model = subject.model;
    const std::vector<Vec3> x = displaced(model, 0.005, random);
    const std::vector<Vec3> inside_out = mirrored(x);
    const Posed posed(subject, precision, x);
    const Posed::Found start = posed.find_corners(1);
    REQUIRE(start.corners.empty());
    REQUIRE(start.due > 1);
    posed.move_to(inside_out);
    const double before = std::nextafter(start.due, 0.0);
    const Posed::Found none = posed.find_corners(before);
    CHECK(none.corners.empty());
    CHECK(none.due == start.due);
    const Posed::Found first = posed.find_corners(start.due);
    CHECK(!first.corners.empty());
    CHECK(first.corners.size() < model.corner_count() / 2);
    CHECK(first.due == -kInfinity);
    // Groups with a corner without margin are looked at again, and no others.
    const Posed::Found again = posed.find_corners(start.due);
    CHECK(again.corners == first.corners);
    CHECK(posed.find_corners(kInfinity).corners.size() == model.corner_count());
    posed.move_to(x);
    const Posed::Found back = posed.find_corners(start.due);
    CHECK(back.corners.empty());
    CHECK(back.due > start.due);
  }
}

TEST_CASE("Looks at groups that are due find what a look at all corners finds") {
  const auto precision = GENERATE(Precision::single_precision, Precision::double_precision);
  // A body is shaken and turned while it is stretched along one axis and squeezed along another.
  const double stretch = GENERATE(0.0, 0.04);
  std::mt19937_64 random(8);
  for (const auto& [name, subject] : subjects()) {
    CAPTURE(name, precision, stretch);
    const MassSpringModel& model = subject.model;
    std::vector<Vec3> x = model.rest;
    const Posed posed(subject, precision, x);
    const double shake = 0.02 * mean_length(model);
    double travel = 0;
    Mat3 turned = Mat3::Identity();
    std::size_t most = 0;
    for (int step = 0; step < 30; ++step) {
      const Mat3 turn =
          Eigen::AngleAxisd(0.1, random_vector(random).normalized()).toRotationMatrix();
      double farthest = 0;
      for (Vec3& each : x) {
        Vec3 by = shake * random_vector(random).normalized();
        const Vec3 from = turned.transpose() * (each - posed.frame.origin);
        by += stretch * Vec3(from.x(), -1.5 * from.y(), 0);
        farthest = std::max(farthest, by.norm());
        each = posed.frame.origin + turn * turned * (from + by);
      }
      turned = turn * turned;
      travel += farthest;
      posed.move_to(x);
      const Posed::Found found = posed.find_corners(travel);
      check_found(model, x, found.corners, rounding(model, precision));
      most = std::max(most, found.corners.size());
    }
    CHECK(most > 0);
  }
}

TEST_CASE("Corners and strains are looked at on every kind of vectors") {
  const auto precision = GENERATE(Precision::single_precision, Precision::double_precision);
  std::mt19937_64 random(2);
  for (const char* name : {"small lattice", "small merged"}) {
    const Subject& subject = subjects().at(name);
    const MassSpringModel& model = subject.model;
    const std::vector<Vec3> x = displaced(model, 0.2, random);
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      CAPTURE(name, precision, hwy::TargetName(target));
      hwy::DisableTargets(target - 1);  // newer instruction sets have lower bits
      const Posed posed(subject, precision, x);
      const Posed::Found found = posed.find_corners();
      posed.move_to(mirrored(x));
      const Posed::Found later = posed.find_corners(kInfinity);
      posed.move_to(x);
      const double strain = posed.largest_strain();
      posed.body->set_rigid_motion({.spin = {3, -2, 5}});
      posed.body->move(0, 0, 0.5);
      const Vec3 departure = posed.body->largest_departure(0);
      hwy::DisableTargets(0);
      REQUIRE(!found.corners.empty());
      check_found(model, x, found.corners, rounding(model, precision));
      check_found(model, mirrored(x), later.corners, rounding(model, precision));
      CHECK(strain == Approx(plain_strain(model, x)).epsilon(1e-5));
      Vec3 expected = Vec3::Zero();
      for (const Vec3& each : x)
        expected =
            expected.cwiseMax((0.5 * Vec3(3, -2, 5).cross(each - posed.frame.origin)).cwiseAbs());
      CHECK((departure - expected).norm() < 1e-5 * expected.norm());
    }
  }
}

TEST_CASE("Corners of a node whose position is not a number have no margin") {
  const auto precision = GENERATE(Precision::single_precision, Precision::double_precision);
  const double wrong = GENERATE(kNan, kInfinity);
  for (const auto& [name, subject] : subjects()) {
    const MassSpringModel& model = subject.model;
    for (const std::uint32_t node : {0U, model.node_count() / 2, model.node_count() - 1}) {
      CAPTURE(name, precision, wrong, node);
      std::vector<Vec3> x = model.rest;
      x[node].y() = wrong;
      std::set<std::uint32_t> expected;
      for (std::uint32_t c = 0; c < model.corner_count(); ++c)
        if (std::count(model.corners[c].node.begin(), model.corners[c].node.end(), node) > 0)
          expected.insert(c);
      // Of an infinite position, some volumes are infinite.
      const Posed posed(subject, precision, x);
      const std::vector<std::uint32_t> corners = posed.find_corners().corners;
      const std::set<std::uint32_t> found(corners.begin(), corners.end());
      if (std::isnan(wrong)) {
        CHECK(found == expected);
        CHECK(std::isnan(posed.largest_strain()));
      } else {
        CHECK_FALSE(posed.largest_strain() < 1);
      }
    }
  }
}

TEST_CASE("The largest strain is that of a plain loop over the springs") {
  const auto precision = GENERATE(Precision::single_precision, Precision::double_precision);
  const double near = precision == Precision::single_precision ? 2e-5 : 1e-12;
  std::mt19937_64 random(3);
  for (const auto& [name, subject] : subjects()) {
    CAPTURE(name, precision);
    const MassSpringModel& model = subject.model;
    const Posed rest(subject, precision, model.rest);
    CHECK(rest.largest_strain() == Approx(plain_strain(model, model.rest)).margin(near));
    const std::vector<Vec3> jittered = displaced(model, 0.1, random);
    for (const double scale : {0.6, 1.0, 1.4}) {  // compression or stretch decides
      std::vector<Vec3> x = jittered;
      for (Vec3& each : x) each *= scale;
      CHECK(Posed(subject, precision, x).largest_strain() ==
            Approx(plain_strain(model, x)).margin(near));
    }
    // Springs within blocks and between them.
    for (std::uint32_t n = 0; n < 20; ++n) {
      const auto s = static_cast<std::uint32_t>(uniform(random) * model.spring_count());
      std::vector<Vec3> x = model.rest;
      x[model.a[s]] = x[model.b[s]] + 3 * (x[model.a[s]] - x[model.b[s]]);
      CHECK(Posed(subject, precision, x).largest_strain() ==
            Approx(plain_strain(model, x)).margin(near));
    }
  }
}

TEST_CASE("The largest departure leaves out a rigid motion, and nodes that do not count") {
  const auto precision = GENERATE(Precision::single_precision, Precision::double_precision);
  const double near = precision == Precision::single_precision ? 1e-6 : 1e-14;
  const RigidMotion rigid{.velocity = {-2, 3, 1}, .spin = {20, -30, 10}};
  constexpr double kDrift = 1e-4;
  constexpr std::uint32_t kEvery = 7;  // a node that does not count
  std::mt19937_64 random(4);
  for (const auto& [name, subject] : subjects()) {
    CAPTURE(name, precision);
    const std::vector<Vec3>& rest = subject.model.rest;
    const Vec3 center = bounds(rest).center();
    std::vector<Vec3> v;
    for (const Vec3& x : rest) v.push_back(rigid.at(x - center) + 0.01 * random_vector(random));
    for (std::size_t i = 0; i < v.size(); i += kEvery) v[i] *= 2;
    const Posed posed(subject, precision, rest, v);
    FastBody& body = *posed.body;
    std::vector<Vec3> x(rest.size());
    for (const bool counts : {true, false, true}) {
      for (std::uint32_t i = 0; i < v.size(); i += kEvery)
        body.count_departure(body.place(i), counts);
      for (const RigidMotion& motion : {RigidMotion(), rigid}) {
        body.set_rigid_motion(motion);
        for (std::uint32_t b = 0; b < body.block_count(); ++b) {
          const Vec3 before = body.largest_departure(b);
          body.move(b, 1, 0);  // no forces yet
          CHECK(body.largest_departure(b) == before);
          body.move(b, 0, kDrift);
          body.get_x(b, posed.frame, x);
          Vec3 expected = Vec3::Zero();
          for (const std::uint32_t node : body.nodes(b))
            if (counts || node % kEvery != 0)
              expected =
                  expected.cwiseMax((kDrift * (v[node] - motion.at(x[node] - center))).cwiseAbs());
          CHECK((body.largest_departure(b) - expected).norm() <=
                near * body.largest_displacement(b).norm());
          CHECK(expected.norm() > 0);
        }
      }
    }
  }
}

TEST_CASE("A rigid motion is fitted to the nodes of a body") {
  const auto precision = GENERATE(Precision::single_precision, Precision::double_precision);
  const double near = precision == Precision::single_precision ? 1e-5 : 1e-12;
  const RigidMotion rigid{.velocity = {-2, 3, 1}, .spin = {20, -30, 10}};
  std::mt19937_64 random(9);
  for (const auto& [name, subject] : subjects()) {
    CAPTURE(name, precision);
    const std::vector<Vec3>& rest = subject.model.rest;
    const Vec3 center = bounds(rest).center();
    for (const double noise : {0.0, 0.1}) {
      std::vector<Vec3> v;
      for (const Vec3& x : rest) v.push_back(rigid.at(x - center) + noise * random_vector(random));
      const Posed posed(subject, precision, rest, v);
      const RigidMotion fit = RigidFit(*posed.body, subject.model.node_count()).fit(*posed.body);
      double farthest = 0;
      for (const Vec3& x : rest)
        farthest = std::max(farthest, (fit.at(x - center) - rigid.at(x - center)).norm());
      CHECK(farthest <= noise + near * 10);
    }
  }
}

TEST_CASE("The rigid motion of few nodes is one of those that fit") {
  // A line and a single node leave a part of the spin open.
  MassSpringModel line;
  line.rest = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  line.mass = {1, 1, 1};
  line.a = {0, 1};
  line.b = {1, 2};
  line.stiffness = {1, 1};
  line.rest_length = {1, 1};
  line.damping = {0, 0};
  const Posed posed({line}, Precision::double_precision, line.rest,
                    {{0, 1, 0}, {0, 2, 0}, {0, 3, 0}});
  const RigidMotion fit = RigidFit(*posed.body, 3).fit(*posed.body);
  CHECK((fit.spin - Vec3(0, 0, 1)).norm() < 1e-12);
}

TEST_CASE("Looking at a body between its steps does not change them") {
  const auto precision = GENERATE(Precision::single_precision, Precision::double_precision);
  std::mt19937_64 random(6);
  for (const auto& [name, subject] : subjects()) {
    CAPTURE(name, precision);
    const MassSpringModel& model = subject.model;
    const std::vector<Vec3> x = displaced(model, 0.05, random);
    const double step = 0.3 * predicted_step(model);
    const auto after_steps = [&](bool looks) {
      const Posed posed(subject, precision, x);
      FastBody& body = *posed.body;
      if (looks) body.set_rigid_motion({.spin = {1, 2, 3}});
      for (int i = 0; i < 5; ++i) {
        for (std::uint32_t b = 0; b < body.block_count(); ++b) body.find_forces(b);
        for (std::uint32_t b = 0; b < body.block_count(); ++b) {
          body.collect_forces(b);
          body.move(b, step, step);
        }
        if (!looks) continue;
        posed.find_corners(i);
        posed.largest_strain();
      }
      std::vector<Vec3> y(x.size());
      for (std::uint32_t b = 0; b < body.block_count(); ++b) body.get_x(b, posed.frame, y);
      return y;
    };
    CHECK(after_steps(true) == after_steps(false));
  }
}

TEST_CASE("A body without corners has none to find") {
  Subject subject = subjects().at("small lattice");
  subject.model.corners.clear();
  const Posed posed(subject, Precision::double_precision, subject.model.rest);
  const Posed::Found found = posed.find_corners(kInfinity);
  CHECK(found.corners.empty());
  CHECK(found.due == kInfinity);
}
