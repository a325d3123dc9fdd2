#include "sim/study/compare.hpp"

#include <atomic>
#include <cmath>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "sim/study/deviation.hpp"
#include "sim/study/ensemble.hpp"
#include "tests/sim/scenes.hpp"

using namespace springlod;
using namespace springlod::sim;

namespace {

Scenario small_scene() {
  return test::small_scene(0.6);
}

void check_same_bits(const StartResult& p, const StartResult& q) {
  CHECK(p.distance == q.distance);
  CHECK(p.surface_error == q.surface_error);
  CHECK(p.shape_error == q.shape_error);
  CHECK(p.simulated == q.simulated);
  CHECK(p.spring_updates == q.spring_updates);
  CHECK(p.ledger_error == q.ledger_error);
}

/// Counts; throws InterruptedError after `limit` units.
class CountingProgress : public Progress {
 public:
  explicit CountingProgress(std::uint64_t limit) : limit_(limit) {}
  void begin(std::string_view, std::uint64_t total) override { total_ = total; }
  void advance(std::uint64_t count) override {
    done_ += count;
    if (done_ > limit_) throw InterruptedError();
  }
  std::uint64_t total() const { return total_; }
  std::uint64_t done() const { return done_; }

 private:
  std::uint64_t limit_;
  std::uint64_t total_ = 0;
  std::atomic<std::uint64_t> done_{0};
};

}  // namespace

TEST_CASE("One and two threads give the same bits", "[threaded]") {
  CompareOptions options;
  options.starts = 3;
  options.variant = "hb";
  options.threads = 1;
  const auto one = compare(test::small_chain(), small_scene(), options);
  options.threads = 2;
  const auto two = compare(test::small_chain(), small_scene(), options);
  REQUIRE(one.levels.size() == 3);
  for (std::size_t l = 0; l < 3; ++l) {
    REQUIRE(one.levels[l].starts.size() == 3);
    for (std::size_t s = 0; s < 3; ++s)
      check_same_bits(one.levels[l].starts[s], two.levels[l].starts[s]);
    CHECK((one.levels[l].first.final.x == two.levels[l].first.final.x));
    REQUIRE(one.levels[l].base_frames.size() == two.levels[l].base_frames.size());
    CHECK((one.levels[l].base_frames.back().x == two.levels[l].base_frames.back().x));
  }
  CHECK(one.levels[0].label == "base");
  CHECK(one.levels[1].label == "hb level 1");
  CHECK(one.levels[2].label == "hb level 2");
}

TEST_CASE("Chains of one base give the results of a comparison of each", "[threaded]") {
  const LodChain longer = test::small_chain();
  LodChain shorter = longer;
  shorter.levels.pop_back();
  CompareOptions options;
  options.starts = 3;
  const auto both = compare({&longer, &shorter}, small_scene(), options, {"a", "b"});
  REQUIRE(both.size() == 2);
  for (const std::size_t c : {0, 1}) {
    const LodChain& chain = c == 0 ? longer : shorter;
    const auto alone = compare(chain, small_scene(), options);
    REQUIRE(both[c].levels.size() == chain.levels.size());
    for (std::size_t l = 0; l < chain.levels.size(); ++l) {
      const LevelRuns& runs = both[c].levels[l];
      CHECK(runs.label ==
            (l == 0 ? "base" : (c == 0 ? "a level " : "b level ") + std::to_string(l)));
      for (std::size_t s = 0; s < options.starts; ++s)
        check_same_bits(runs.starts[s], alone.levels[l].starts[s]);
      CHECK(runs.first.frames.back().x == alone.levels[l].first.frames.back().x);
      CHECK(runs.base_frames.size() == alone.levels[l].base_frames.size());
    }
  }

  LodChain other = shorter;
  other.levels[0].model.mass[0] *= 2;
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(compare({&longer, &other}, small_scene(), options, {}),
                    Contains("chain 2 has another base"));
  CHECK_THROWS_WITH(compare({&longer, &shorter}, small_scene(), options, {"a"}),
                    Contains("1 variants do not name 2 chains"));
  CHECK_THROWS_AS(compare({}, small_scene(), options, {}), InputError);
}

TEST_CASE("Every level starts from the same jittered throw") {
  CompareOptions options;
  options.starts = 4;
  options.jitter = 0.1;
  Scenario scene = small_scene();
  scene.obstacles.clear();  // in free flight, the distance depends only on the throw
  const auto result = compare(test::small_chain(), scene, options);
  for (std::size_t s = 0; s < 4; ++s)
    for (std::size_t l = 1; l < 3; ++l)
      CHECK(result.levels[l].starts[s].distance ==
            Approx(result.levels[0].starts[s].distance).epsilon(1e-9));
  CHECK(result.levels[0].starts[0].distance == Approx(1.2));
  CHECK(result.levels[0].starts[1].distance != Approx(1.2).epsilon(1e-6));
}

TEST_CASE("Starts that would not differ are run once") {
  const auto starts_of = [](const Scenario& scene, double jitter, const Anchor& anchor) {
    CompareOptions options;
    options.starts = 3;
    options.jitter = jitter;
    options.run.anchors = {anchor};
    const auto result = compare(test::small_chain(), scene, options);
    CHECK(result.levels[1].starts.size() == result.levels[0].starts.size());
    return result.levels[0].starts.size();
  };
  Scenario thrown = small_scene();
  thrown.duration = 0.01;
  Scenario lifted = thrown;  // over the floor
  lifted.start.velocity = Vec3::Zero();
  Scenario alone = lifted;
  alone.obstacles.clear();
  Anchor anchor{.name = "vice", .nodes = {0}};
  CHECK(starts_of(thrown, 0.1, anchor) == 3);
  CHECK(starts_of(thrown, 0, anchor) == 1);
  CHECK(starts_of(lifted, 0.1, anchor) == 3);
  CHECK(starts_of(alone, 0.1, anchor) == 1);
  // About a fixed pivot, the body turns with another arm.
  anchor.path = {{.time = 0.01, .turn = {0.1, 0, 0}}};
  CHECK(starts_of(alone, 0.1, anchor) == 1);
  anchor.pivot = Vec3::Zero();
  CHECK(starts_of(alone, 0.1, anchor) == 3);
}

TEST_CASE("Jitter scales speed and height within its range and depends on seed and index alone") {
  const Throw start = small_scene().start;
  const Vec3 center(7, 8, 9);
  CHECK(jittered(start, center, 0.1, 1, 0).velocity == start.velocity);
  CHECK(jittered(start, center, 0.1, 1, 0).position == start.position);
  double lowest = 1;
  double highest = 1;
  for (std::uint32_t s = 1; s < 200; ++s) {
    const Throw changed = jittered(start, center, 0.1, 1, s);
    const double speed = changed.velocity.norm() / start.velocity.norm();
    const double height = changed.position.z() / start.position.z();
    CHECK(std::abs(height - 1) <= 0.1);
    CHECK(changed.position.head<2>() == start.position.head<2>());
    CHECK(changed.spin == start.spin);
    CHECK(speed != height);
    lowest = std::min(lowest, speed);
    highest = std::max(highest, speed);
  }
  CHECK(lowest < 0.91);
  CHECK(lowest >= 0.9);
  CHECK(highest > 1.09);
  CHECK(highest <= 1.1);
  CHECK(jittered(start, center, 0.1, 1, 5).velocity == jittered(start, center, 0.1, 1, 5).velocity);
  CHECK(jittered(start, center, 0.1, 2, 5).velocity != jittered(start, center, 0.1, 1, 5).velocity);
  Throw in_place;
  in_place.velocity = {1, 0, 0};
  const Throw moved = jittered(in_place, center, 0.1, 1, 3);
  CHECK(moved.placed);
  CHECK(moved.position.head<2>() == center.head<2>());
  CHECK(moved.position.z() != center.z());
}

TEST_CASE("Errors are 0 for the base, grow with the level and ignore rigid motion in the shape") {
  CompareOptions options;
  options.threads = 2;
  const auto result = compare(test::small_chain(), small_scene(), options);
  CHECK(result.levels[0].starts[0].surface_error == 0);
  CHECK(result.levels[0].starts[0].shape_error == 0);
  for (std::size_t l = 1; l < 3; ++l) {
    const StartResult& r = result.levels[l].starts[0];
    CHECK(r.surface_error > 1e-4);
    CHECK(r.surface_error < 0.1);
    CHECK(r.shape_error > 1e-4);
    CHECK(r.shape_error < 0.1);
    CHECK(r.spring_updates < result.levels[0].starts[0].spring_updates);
    CHECK(r.ledger_error < 0.01);
    CHECK(result.levels[l].base_frames.front().x.size() ==
          test::small_chain().levels[0].model.rest.size());
  }
}

TEST_CASE("Before contact a level that flies like the base has no error") {
  Scenario scene = small_scene();
  scene.obstacles.clear();
  scene.start.spin = Vec3::Zero();
  CompareOptions options;
  const auto result = compare(test::small_chain(), scene, options);
  CHECK(result.levels[1].starts[0].surface_error < 1e-5);  // chords between steps: g dt^2 / 8
  CHECK(result.levels[1].starts[0].shape_error < 1e-9);
}

TEST_CASE(
    "Deviation over time is computed frame by frame, as far as two runs have the same instants") {
  const std::vector<double> mass{1, 3};
  const std::vector<Vec3> rest{Vec3(0, 0, 0), Vec3(1, 0, 0)};
  const std::vector<Vec3> moved{Vec3(0, 0, 2), Vec3(1, 0, 2)};
  const std::vector<Vec3> longer{Vec3(0, 0, 0), Vec3(1.4, 0, 0)};
  const std::vector<Frame> base{{0, rest}, {0.1, rest}, {0.2, rest}, {0.3, rest}};
  const std::vector<Frame> run{{0, rest}, {0.1 + 1e-12, moved}, {0.2, longer}, {0.25, rest}};
  const auto list = deviation_over_time(run, base, mass);
  REQUIRE(list.size() == 3);  // the run was stopped at 0.25
  CHECK(list[0].surface == 0);
  CHECK(list[1].surface == Approx(2));
  CHECK(list[1].shape == Approx(0).margin(1e-12));
  CHECK(list[2].time == 0.2);
  CHECK(list[2].surface == Approx(0.4 * std::sqrt(0.75)));
  // 0.3 and 0.1 from their common centre
  CHECK(list[2].shape == Approx(std::sqrt((0.09 + 3 * 0.01) / 4)));
}

TEST_CASE("The best rigid fit finds a rotation and distinguishes a mirror image from it") {
  const auto model = test::rods();
  const Mat3 turn = Eigen::AngleAxisd(2.5, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  std::vector<Vec3> moved;
  std::vector<Vec3> bumped;
  std::vector<Vec3> p = model.rest;
  p[0] += Vec3(0.1, 0.2, 0.3);  // so that the body has no mirror plane
  for (const Vec3& x : p) moved.emplace_back(turn * x + Vec3(5, 6, 7));
  CHECK(rms_distance(p, moved, model.mass) > 1);
  CHECK(rms_distance_after_fit(p, moved, model.mass) < 1e-9);
  for (const Vec3& x : p) bumped.emplace_back(-x.x(), x.y(), x.z());
  CHECK(rms_distance_after_fit(p, bumped, model.mass) > 1e-3);
  CHECK(rms_distance({Vec3(0, 0, 0), Vec3(1, 0, 0)}, {Vec3(0, 0, 0), Vec3(1, 2, 0)}, {3, 1}) ==
        Approx(1));
}

TEST_CASE("The error of the first run that failed reaches the caller with level and start") {
  CompareOptions options;
  options.starts = 4;
  options.run.step = 0.1;
  options.threads = GENERATE(1U, 2U);
  try {
    compare(test::small_chain(), small_scene(), options);
    FAIL("an unstable step went through");
  } catch (const UnstableError& e) {
    CHECK_THAT(e.what(), Catch::StartsWith("base, start 1"));
  }
}

TEST_CASE("An interrupt stops all runs") {
  CompareOptions options;
  options.starts = 4;
  options.threads = GENERATE(1U, 2U);
  CountingProgress progress(500);
  options.progress = &progress;
  CHECK_THROWS_AS(compare(test::small_chain(), small_scene(), options), InterruptedError);
  CHECK(progress.done() < 2000);
}

TEST_CASE("Progress ends at its total, stop rules or not") {
  Scenario scene = small_scene();
  scene.start.position.z() = 0.2;
  scene.start.velocity = {0.5, 0, 0};
  scene.start.spin = Vec3::Zero();
  scene.stop = StopRule{5, 0.05};
  CountingProgress progress(~std::uint64_t{0});
  CompareOptions options;
  options.progress = &progress;
  const auto result = compare(test::small_chain(), scene, options);
  CHECK(result.levels[0].starts[0].simulated < 0.2);
  CHECK(progress.done() == progress.total());
}

TEST_CASE("Wrong compare options are refused by name") {
  CHECK_THROWS_WITH(compare({}, small_scene(), {}), Catch::Contains("no levels"));
  CHECK_THROWS_WITH(compare(test::small_chain(), small_scene(), {.starts = 0}),
                    Catch::Contains("starts"));
  CHECK_THROWS_WITH(compare(test::small_chain(), small_scene(), {.jitter = 1}),
                    Catch::Contains("jitter"));
}

TEST_CASE("The energy difference is none between equal models and some between levels") {
  LodChain same;
  same.levels = {test::small_chain().levels[0], test::small_chain().levels[0]};
  const Comparison equal = compare(same, small_scene());
  CHECK(equal.levels[1].starts[0].energy_difference == 0);
  const Comparison coarser = compare(test::small_chain(), small_scene());
  CHECK(coarser.levels[0].starts[0].energy_difference == 0);
  CHECK(coarser.levels[1].starts[0].energy_difference > 1e-3);
  CHECK(coarser.levels[1].starts[0].energy_difference < 1);
}
