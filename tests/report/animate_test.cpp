#include "report/animate.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "render/frames.hpp"
#include "render/overlay.hpp"
#include "report/playback.hpp"
#include "tests/render/bodies.hpp"
#include "tests/render/golden.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace springlod;
using namespace springlod::report;
using namespace springlod::test;

namespace {

// Input of an animation, without simulation: a bar that flies towards a wall and bends.
struct Film {
  LodAsset asset;
  sim::Comparison comparison;

  explicit Film(double duration = 0.5) {
    Level base{bar(), {}, "base"};
    base.of_base = identity_groups(base.model.node_count());
    asset.chain.levels = {base, base};
    asset.surface = dumbbell_mesh(16);
    asset.surface_of_base = bind_points(asset.surface.positions, base.model);
    comparison.scenario.obstacles = {{sim::Plane{Vec3::UnitZ(), 0}, "floor"},
                                     {sim::Plane{-Vec3::UnitX(), -1.2}, "wall"}};
    for (std::uint32_t level = 0; level < 2; ++level) {
      sim::LevelRuns runs;
      runs.label = level == 0 ? "base" : "level 1";
      runs.level = level;
      runs.first.spring_updates = level == 0 ? 18600 : 1000;
      runs.starts.resize(1);
      runs.starts[0].surface_error = level == 0 ? 0 : 0.0123;
      for (int k = 0; k <= 10; ++k) {
        const double t = duration * k / 10;
        runs.first.frames.push_back(
            {t, bent(base.model.rest, 0.01 + t, Vec3(t - 0.3, 0, 0.3 - 0.2 * t))});
      }
      runs.base_frames = runs.first.frames;
      comparison.levels.push_back(runs);
    }
  }
};

AnimateOptions small() {
  AnimateOptions options;
  options.width = 160;
  options.height = 120;
  return options;
}

std::size_t files_in(const std::filesystem::path& folder) {
  const std::filesystem::directory_iterator all(folder);
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

}  // namespace

TEST_CASE("positions are interpolated between frames and held outside") {
  const std::vector<sim::Frame> frames{
      {0, {Vec3(0, 0, 0)}}, {1, {Vec3(2, 0, 0)}}, {3, {Vec3(4, 0, 0)}}};
  CHECK(positions_at(frames, -1)[0].x() == 0);
  CHECK(positions_at(frames, 0.25)[0].x() == Approx(0.5));
  CHECK(positions_at(frames, 1)[0].x() == Approx(2));
  CHECK(positions_at(frames, 2)[0].x() == Approx(3));
  CHECK(positions_at(frames, 99)[0].x() == 4);
}

TEST_CASE("smoothing keeps straight paths and their ends") {
  std::vector<Vec3> path;
  for (int i = 0; i < 10; ++i) path.emplace_back(i, 2 * i, 0);
  const auto smooth = smoothed(path, 3);
  for (std::size_t i = 0; i < path.size(); ++i) CHECK((smooth[i] - path[i]).norm() < 1e-12);
  path[5].z() = 7;
  CHECK(smoothed(path, 3)[5].z() == Approx(1));
}

TEST_CASE("base and level are drawn side by side, synchronized") {
  const TemporaryFolder folder;
  const Film film;
  const Animation animation = animate({{film.asset, film.comparison}}, folder.path(), small());
  CHECK(animation.frames == 16);  // 0.5 s at 30 frames per second, first and last included
  CHECK(files_in(folder.path()) == 16);
  const render::Image first = render::load_png(render::frame_path(folder.path(), 0));
  CHECK(first.width == 2 * 160);
  CHECK(first.height == 120);
  const render::Image last = render::load_png(render::frame_path(folder.path(), 15));
  CHECK(render::difference(first, last).share_beyond > 0.01);
}

TEST_CASE("several chains share the base of the first one, and levels can be chosen") {
  const TemporaryFolder folder;
  const Film film;
  const Film other;
  const auto panels = [&](const std::vector<std::uint32_t>& levels) {
    AnimateOptions options = small();
    options.frames = 1;
    options.levels = levels;
    animate({{film.asset, film.comparison}, {other.asset, other.comparison}}, folder.path(),
            options);
    return render::load_png(render::frame_path(folder.path(), 0)).width / 160;
  };
  CHECK(panels({}) == 3);  // base, level 1 of both
  CHECK(panels({1}) == 2);
  CHECK(panels({0}) == 1);
  CHECK_THROWS_WITH(panels({7}), Catch::Contains("levels has none of the levels of the runs"));
}

TEST_CASE("a caption names the time until which its error is the mean, unless that is the end") {
  Film film;
  sim::Comparison& comparison = film.comparison;
  const auto caption = [&] {
    return filmed_runs({{film.asset, comparison}}, {})[1].captions.back();
  };
  comparison.error_window = 0.25;
  CHECK(caption() == "mean error 12 mm");  // without contact, of the whole run
  comparison.levels[0].first.first_contact = 0.17;
  CHECK(caption() == "error 12 mm until t = 0.42 s");
  comparison.error_window = 0.4;
  CHECK_FALSE(sim::error_end(comparison));
  CHECK(caption() == "mean error 12 mm");
}

TEST_CASE("a frame of an animation matches its golden image") {
  const TemporaryFolder folder;
  const Film film;
  AnimateOptions options = small();
  options.width = 240;
  options.height = 180;
  options.frame_rate = 4;
  animate({{film.asset, film.comparison}}, folder.path(), options);
  check_golden(render::load_png(render::frame_path(folder.path(), 1)), "animation");
}

TEST_CASE("slow motion makes more frames, a limit fewer, and surplus old frames are removed") {
  const TemporaryFolder folder;
  const Film film;
  AnimateOptions options = small();
  options.width = 32;
  options.height = 24;
  options.slow = 2;
  CHECK(animate({{film.asset, film.comparison}}, folder.path(), options).frames == 31);
  render::save_png(render::Image{1, 1, {0, 0, 0}}, folder.path() / "frame_other.png");
  options.frames = 5;
  CHECK(animate({{film.asset, film.comparison}}, folder.path(), options).frames == 5);
  CHECK(files_in(folder.path()) == 6);
  CHECK(std::filesystem::exists(folder.path() / "frame_other.png"));
  CHECK_FALSE(std::filesystem::exists(render::frame_path(folder.path(), 5)));
}

TEST_CASE("a limit of frames spreads them over the run, unless a frame rate is given") {
  const TemporaryFolder folder;
  const Film film;  // 0.5 s
  AnimateOptions options = small();
  options.width = 32;
  options.height = 24;
  const auto drawn = [&](const char* name) {
    return animate({{film.asset, film.comparison}}, folder.path() / name, options);
  };
  const Animation whole = drawn("whole");
  CHECK(whole.frame_rate == kUsualFrameRate);
  options.frames = 100;  // more than the film has
  CHECK(drawn("whole").frame_rate == kUsualFrameRate);
  CHECK(drawn("whole").frames == 16);
  options.frames = 4;
  const Animation spread = drawn("spread");
  CHECK(spread.frames == 4);
  CHECK(spread.frame_rate == Approx(3 / 0.5));
  options.slow = 2;
  CHECK(drawn("slow").frame_rate == Approx(3 / (2 * 0.5)));
  options.slow = 1;
  options.frame_rate = 30;
  const Animation cut = drawn("cut");
  CHECK(cut.frames == 4);
  CHECK(cut.frame_rate == 30);
  const auto picture = [&](const char* name, std::uint32_t frame) {
    return render::load_png(render::frame_path(folder.path() / name, frame));
  };
  // The last one shows the end.
  CHECK(render::difference(picture("spread", 3), picture("whole", 15)).share_beyond < 0.01);
  CHECK(render::difference(picture("cut", 3), picture("whole", 15)).share_beyond > 0.01);
}

TEST_CASE("a run that ended early holds its last frame") {
  const TemporaryFolder folder;
  Film film;
  film.comparison.levels[1].first.frames.resize(3);
  film.comparison.levels[1].base_frames.resize(3);
  AnimateOptions options = small();
  animate({{film.asset, film.comparison}}, folder.path(), options);
  const render::Image a = render::load_png(render::frame_path(folder.path(), 8));
  const render::Image b = render::load_png(render::frame_path(folder.path(), 14));
  std::size_t left = 0;
  std::size_t right = 0;
  // The upper three quarters: the clock below continues.
  for (std::size_t y = 0; y < 90; ++y)
    for (std::size_t x = 0; x < 320; ++x) {
      const std::size_t p = 3 * (y * 320 + x);
      const bool same = std::equal(&a.rgb[p], &a.rgb[p] + 3, &b.rgb[p]);
      (x < 159 ? left : right) += same ? 0 : 1;
    }
  CHECK(left > 100);
  CHECK(right == 0);
}

TEST_CASE("follow camera, nodes and springs, and an asset without surface can be drawn") {
  const TemporaryFolder folder;
  Film film;
  film.asset.surface = {};
  film.asset.surface_of_base = {};
  AnimateOptions options = small();
  options.camera = CameraMode::follow;
  options.frames = 2;
  CHECK(animate({{film.asset, film.comparison}}, folder.path(), options).frames == 2);
  options.style.spring_colour = render::SpringColour::strain;
  options.style.springs = true;
  CHECK(animate({{film.asset, film.comparison}}, folder.path(), options).frames == 2);
}

TEST_CASE("the follow camera keeps a tumbling body between the labels, near the middle") {
  const TemporaryFolder folder;
  Film film;
  film.comparison.scenario.obstacles.pop_back();  // the wall
  const MassSpringModel& model = film.asset.chain.levels[0].model;
  // Up and down again, 4 m far, with a sudden turn at the floor.
  for (sim::LevelRuns& runs : film.comparison.levels) {
    runs.first.frames.clear();
    for (int k = 0; k <= 40; ++k) {
      const double t = k / 40.;
      const Mat3 turn = Eigen::AngleAxisd(9 * t, Vec3(0.3, 1, 0).normalized()).toRotationMatrix();
      const Vec3 move(4 * t, 0, 0.5 + std::abs(1.5 - 3 * t));
      sim::Frame frame{t, {}};
      for (const Vec3& p : model.rest) frame.x.emplace_back(turn * p + move);
      runs.first.frames.push_back(std::move(frame));
    }
    runs.base_frames = runs.first.frames;
  }
  AnimateOptions options = small();
  options.camera = CameraMode::follow;
  const Animation animation = animate({{film.asset, film.comparison}}, folder.path(), options);
  REQUIRE(animation.frames == 31);
  for (std::uint32_t k = 0; k < animation.frames; ++k) {
    const render::Image frame = render::load_png(render::frame_path(folder.path(), k));
    for (const int left : {0, 160}) {
      Eigen::AlignedBox2i box;
      for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 160; ++x) {
          const std::uint8_t* p = &frame.rgb[3 * static_cast<std::size_t>(y * 320 + left + x)];
          const auto [low, high] = std::minmax({p[0], p[1], p[2]});
          if (high - low > 60) box.extend(Eigen::Vector2i(x, y));  // the body alone has colours
        }
      CAPTURE(k, left, box.min().transpose(), box.max().transpose());
      REQUIRE_FALSE(box.isEmpty());
      CHECK(box.min().x() > 2);
      CHECK(box.max().x() < 157);
      CHECK(box.min().y() > 120 * render::heading_share(120, left == 0 ? 1 : 2) - 4);
      CHECK(box.max().y() < 117);
      CHECK(std::abs(box.center().x() - 80) < 20);
      CHECK(box.sizes().maxCoeff() > 18);
    }
  }
}

TEST_CASE("the camera avoids a wall that would hide the motion") {
  const TemporaryFolder folder;
  const Film film;  // its wall is at +x, facing -x; the default eye is at +x
  AnimateOptions options = small();
  options.frames = 1;
  animate({{film.asset, film.comparison}}, folder.path() / "round", options);
  options.avoid_walls = false;
  animate({{film.asset, film.comparison}}, folder.path() / "behind", options);
  options.azimuth = -110;
  animate({{film.asset, film.comparison}}, folder.path() / "mirrored", options);
  const render::Image round = render::load_png(render::frame_path(folder.path() / "round", 0));
  CHECK(round.rgb == render::load_png(render::frame_path(folder.path() / "mirrored", 0)).rgb);
  CHECK(round.rgb != render::load_png(render::frame_path(folder.path() / "behind", 0)).rgb);
}

TEST_CASE("runs that do not fit the asset are refused") {
  const TemporaryFolder folder;
  const Film film;
  const auto refused = [&](const sim::Comparison& comparison, const char* why) {
    CHECK_THROWS_WITH(animate({{film.asset, comparison}}, folder.path(), small()),
                      Catch::Contains(why));
  };
  sim::Comparison wrong = film.comparison;
  wrong.levels.clear();
  refused(wrong, "no runs");
  wrong = film.comparison;
  wrong.levels[1].level = 7;
  refused(wrong, "level 7");
  wrong = film.comparison;
  wrong.levels[1].first.frames[2].x.pop_back();
  refused(wrong, "another asset");
  wrong = film.comparison;
  wrong.levels[0].base_frames.clear();
  refused(wrong, "no frames");
  AnimateOptions options = small();
  options.frame_rate = 0;
  CHECK_THROWS_AS(animate({{film.asset, film.comparison}}, folder.path(), options), InputError);
  options.frame_rate = 1e12;
  CHECK_THROWS_WITH(animate({{film.asset, film.comparison}}, folder.path(), options),
                    Catch::Contains("frame_rate"));
}

TEST_CASE("a frame that cannot be written ends the animation with its name") {
  const TemporaryFolder folder;
  const Film film;
  // A folder that is not empty cannot be replaced by a file.
  std::filesystem::create_directories(render::frame_path(folder.path(), 3) / "in the way");
  CHECK_THROWS_AS(animate({{film.asset, film.comparison}}, folder.path(), small()), IoError);
  CHECK_THROWS_WITH(animate({{film.asset, film.comparison}}, folder.path(), small()),
                    Catch::Matchers::Contains("frame_0003.png"));
  CHECK(std::filesystem::exists(render::frame_path(folder.path(), 2)));
  CHECK_FALSE(std::filesystem::exists(render::frame_path(folder.path(), 4)));
}
