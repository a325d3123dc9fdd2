// Films of single runs: trajectories of any bodies and scenarios.

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "render/frames.hpp"
#include "report/animate.hpp"
#include "report/film_cameras.hpp"
#include "tests/render/bodies.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace springlod;
using namespace springlod::report;
using namespace springlod::test;

namespace {

// A bar that flies along x at 1 m/s, without simulation.
struct Flight {
  MassSpringModel model;
  sim::Trajectory trajectory;
  sim::Scenario scenario;

  explicit Flight(double a = 0.04, int frames = 11) : model(bar(a)) {
    for (int k = 0; k < frames; ++k)
      trajectory.frames.push_back({0.05 * k, moved(model.rest, Vec3(0.05 * k, 0, 0.3))});
    trajectory.spring_updates = 2'000'000;
    scenario.obstacles = {{sim::Plane{Vec3::UnitZ(), 0}, "floor"}};
  }
  LabelledRun as(const std::string& label) const { return {label, model, trajectory, scenario}; }
};

AnimateOptions small() {
  AnimateOptions options;
  options.width = 200;
  options.height = 150;
  options.frame_rate = 20;
  return options;
}

double distance_of(const render::Camera& camera) {
  return (camera.eye - camera.target).norm();
}

}  // namespace

TEST_CASE("runs stand side by side or in rows, each with its label, cost and surface") {
  const Flight flight;
  LabelledRun covered = flight.as("covered");
  const TriangleMesh mesh = dumbbell_mesh(16);
  covered.surface = &mesh;
  covered.surface_of_nodes = bind_points(mesh.positions, flight.model);
  const std::vector<FilmedRun> runs = filmed_runs({flight.as("bare"), covered, flight.as("c")});
  CHECK(runs[0].title == "bare: 368 nodes, 2374 springs");
  CHECK(runs[0].captions == std::vector<std::string>{"2 million spring updates"});
  CHECK(runs[0].surface == nullptr);
  CHECK(runs[1].surface == &mesh);
  CHECK(runs[1].part_colours.size() == 3);

  const TemporaryFolder folder;
  AnimateOptions options = small();
  CHECK(animate(runs, folder.path(), options).frames == 11);
  const render::Image row = render::load_png(render::frame_path(folder.path(), 0));
  CHECK(row.width == 3 * 200);
  CHECK(row.height == 150);
  options.columns = 2;
  options.frames = 1;
  animate(runs, folder.path(), options);
  const render::Image rows = render::load_png(render::frame_path(folder.path(), 0));
  CHECK(rows.width == 2 * 200);
  CHECK(rows.height == 2 * 150);
}

TEST_CASE("the anchored nodes of a run are marked in all its pictures, unless the style says no") {
  const Flight free;
  Flight held = free;
  held.trajectory.anchored = {0};
  const auto differing = [&](bool anchors, std::uint32_t frame) {
    const TemporaryFolder folder;
    AnimateOptions options = small();
    options.style.anchors = anchors;
    animate(filmed_runs({free.as("A"), held.as("A")}), folder.path(), options);
    const render::Image image = render::load_png(render::frame_path(folder.path(), frame));
    std::size_t pixels = 0;
    for (std::size_t y = 40; y < 120; ++y)  // without the divider and the words in the corners
      for (std::size_t x = 2; x < 198; ++x) {
        const std::size_t p = 3 * (y * 400 + x);
        pixels += std::equal(&image.rgb[p], &image.rgb[p] + 3, &image.rgb[p] + 600) ? 0 : 1;
      }
    return pixels;
  };
  CHECK(differing(false, 0) == 0);
  for (const std::uint32_t frame : {0U, 10U}) CHECK(differing(true, frame) > 20);
}

TEST_CASE("the panel of a run that ended before others holds its last frame and says so") {
  const Flight whole;
  const Flight early(0.04, 5);  // ends at 0.2 s
  Flight still = early;         // the same, but its body stays there until the end
  for (int k = 5; k < 11; ++k)
    still.trajectory.frames.push_back({0.05 * k, still.trajectory.frames[4].x});
  const auto last_frame = [&](const Flight& second) {
    const TemporaryFolder folder;
    animate(filmed_runs({whole.as("A"), second.as("B")}), folder.path(), small());
    return render::load_png(render::frame_path(folder.path(), 10));
  };
  const render::Image held = last_frame(early);
  const render::Image stayed = last_frame(still);
  REQUIRE(held.rgb.size() == stayed.rgb.size());
  std::size_t words = 0;
  std::size_t elsewhere = 0;
  for (std::size_t y = 0; y < 150; ++y)
    for (std::size_t x = 0; x < 400; ++x) {
      const std::size_t p = 3 * (y * 400 + x);
      if (std::equal(&held.rgb[p], &held.rgb[p] + 3, &stayed.rgb[p])) continue;
      (x >= 200 && y < 60 ? words : elsewhere) += 1;
    }
  CHECK(words > 200);
  CHECK(elsewhere == 0);
}

TEST_CASE(
    "a fixed camera is shared by bodies of one size and fills each panel with those of others") {
  const Flight one;
  Flight other;  // elsewhere, in front of a wall that would hide both from the default direction
  for (sim::Frame& frame : other.trajectory.frames) frame.x = moved(frame.x, Vec3(0, 0, 0.5));
  other.scenario.obstacles.push_back({sim::Plane{-Vec3::UnitX(), -1.2}, "wall"});
  const std::vector<double> times{0, 0.25, 0.5};
  const auto cameras = [&](const Flight& second, CameraMode mode) {
    AnimateOptions options = small();
    options.camera = mode;
    return film_cameras(filmed_runs({one.as("A"), second.as("B")}), times, options);
  };
  const auto shared = cameras(other, CameraMode::fixed);
  REQUIRE(shared.size() == 2);
  CHECK(shared[0].size() == 3);
  CHECK(shared[0][0].eye == shared[1][2].eye);
  CHECK(shared[0][0].eye.x() < shared[0][0].target.x());  // the wall of B is seen from its front

  const Flight large(0.4);  // ten times the size, at the same speed
  const auto own = cameras(large, CameraMode::fixed);
  CHECK(distance_of(own[1][0]) > 4 * distance_of(own[0][0]));
  CHECK(own[1][0].eye == own[1][2].eye);
  const auto following = cameras(large, CameraMode::follow);
  CHECK(distance_of(following[1][0]) == Approx(10 * distance_of(following[0][0])).epsilon(0.1));
  CHECK(following[0][2].target.x() - following[0][0].target.x() == Approx(0.5).margin(0.05));

  CHECK(differ_in_size({1, 1.6}));
  CHECK_FALSE(differ_in_size({1, 1.4}));
  CHECK_FALSE(differ_in_size({}));
}

TEST_CASE("runs without motion to show are refused by their labels") {
  const TemporaryFolder folder;
  const Flight flight;
  const auto refused = [&](const Flight& second, const char* why) {
    CHECK_THROWS_WITH(
        animate(filmed_runs({flight.as("A"), second.as("B")}), folder.path(), small()),
        Catch::Contains("\"B\"") && Catch::Contains(why));
  };
  CHECK_THROWS_WITH(animate(std::vector<FilmedRun>{}, folder.path(), small()),
                    Catch::Contains("no runs"));
  Flight ends = flight;  // recorded with frame_rate = 0
  ends.trajectory.frames.erase(ends.trajectory.frames.begin() + 1,
                               ends.trajectory.frames.end() - 1);
  refused(ends, "only its first and its last frame; run it with a frame_rate");
  Flight empty = flight;
  empty.trajectory.frames.clear();
  refused(empty, "kept no frames");
  CHECK_FALSE(std::filesystem::exists(render::frame_path(folder.path(), 0)));
}
