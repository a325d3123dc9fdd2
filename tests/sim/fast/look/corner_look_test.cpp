// The corners that looks at fast layouts find, compared with plain loops over the model.

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <catch2/catch.hpp>

#include "model/corners.hpp"
#include "tests/sim/fast/look/posed.hpp"
#include "tests/sim/vector_targets.hpp"

using namespace springlod;
using namespace springlod::sim;
using namespace springlod::test;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

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
    std::map<bool, std::vector<double>> first;  // by whether products are fused
    CAPTURE(name, precision);
    on_each_target([&] {
      const Posed posed(subject, precision, x);
      const Posed::Found found = posed.find_corners();
      posed.move_to(mirrored(x));
      const Posed::Found later = posed.find_corners(kInfinity);
      posed.move_to(x);
      const double strain = posed.largest_strain();
      posed.move_to(model.rest);
      const double rest_due = posed.find_corners(kInfinity).due;
      posed.move_to(x);
      posed.body->set_rigid_motion({.spin = {3, -2, 5}});
      posed.body->move(0, 0, 0.5);
      const Vec3 departure = posed.body->largest_departure(0);
      const std::vector<double> all{found.due,     later.due,     strain,  departure.x(),
                                    departure.y(), departure.z(), rest_due};
      CHECK(first.try_emplace(sim::fuses_products(), all).first->second == all);  // the same bits
      REQUIRE(!found.corners.empty());
      check_found(model, x, found.corners, rounding(model, precision));
      check_found(model, mirrored(x), later.corners, rounding(model, precision));
      CHECK(strain == Approx(plain_strain(model, x)).epsilon(1e-5));
      Vec3 expected = Vec3::Zero();
      for (const Vec3& each : x)
        expected =
            expected.cwiseMax((0.5 * Vec3(3, -2, 5).cross(each - posed.frame.origin)).cwiseAbs());
      CHECK((departure - expected).norm() < 1e-5 * expected.norm());
    });
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

TEST_CASE("A body without corners has none to find") {
  Subject subject = subjects().at("small lattice");
  subject.model.corners.clear();
  const Posed posed(subject, Precision::double_precision, subject.model.rest);
  const Posed::Found found = posed.find_corners(kInfinity);
  CHECK(found.corners.empty());
  CHECK(found.due == kInfinity);
}
