#include "report/animate.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <exception>
#include <functional>
#include <numbers>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/temporary_file.hpp"
#include "base/units.hpp"
#include "model/drawn_colour.hpp"
#include "render/frame_writer.hpp"
#include "render/frames.hpp"
#include "report/part_materials.hpp"
#include "report/playback.hpp"

namespace springlod::report {
namespace {

namespace fs = std::filesystem;

void require_matching(const ComparedChain& chain) {
  const auto& [asset, comparison] = chain;
  if (comparison.levels.empty()) throw InputError("animation: the comparison has no runs");
  const std::vector<Level>& levels = asset.chain.levels;
  for (const sim::LevelRuns& runs : comparison.levels) {
    if (runs.level >= levels.size())
      throw InputError(fmt::format("animation: \"{}\" is of level {}, but the asset has {} levels",
                                   runs.label, runs.level, levels.size()));
    const auto require_frames = [&](const std::vector<sim::Frame>& frames, std::uint32_t nodes) {
      if (frames.empty())
        throw InputError(
            fmt::format("animation: \"{}\" kept no frames; run it with a frame rate", runs.label));
      for (const sim::Frame& frame : frames)
        if (frame.x.size() != nodes)
          throw InputError(
              fmt::format("animation: \"{}\" has {} positions a frame where the asset "
                          "has {} nodes; is it from another asset?",
                          runs.label, frame.x.size(), nodes));
    };
    require_frames(runs.first.frames, levels[runs.level].model.node_count());
    require_frames(runs.base_frames, levels[0].model.node_count());
  }
}

void require_sane(const AnimateOptions& options) {
  if (!(options.frame_rate > 0) || !std::isfinite(options.frame_rate) || !(options.slow > 0) ||
      !std::isfinite(options.slow))
    throw InputError(fmt::format("animation: frame_rate = {} and slow = {} must be above 0",
                                 options.frame_rate, options.slow));
}

/// A run that is drawn in a panel of its own.
struct DrawnRun {
  ComparedChain chain;
  const sim::LevelRuns& runs;
};

/// The base of the first chain, and the levels of all.
std::vector<DrawnRun> drawn_runs(const std::vector<ComparedChain>& chains,
                                 const std::vector<std::uint32_t>& levels) {
  std::vector<DrawnRun> drawn;
  for (const ComparedChain& chain : chains) {
    require_matching(chain);
    for (const sim::LevelRuns& runs : chain.comparison.levels) {
      const bool again = runs.level == 0 && &chain != chains.data();
      const bool chosen =
          levels.empty() || std::find(levels.begin(), levels.end(), runs.level) != levels.end();
      if (chosen && !again) drawn.push_back({chain, runs});
    }
  }
  if (drawn.empty()) throw InputError("animation: levels has none of the levels of the runs");
  return drawn;
}

/// The times of the frames [s].
std::vector<double> picture_times(const std::vector<DrawnRun>& drawn,
                                  const AnimateOptions& options) {
  double end = 0;
  for (const auto& [chain, runs] : drawn)
    end = std::max({end, runs.first.frames.back().time, runs.base_frames.back().time});
  const double apart = 1 / (options.frame_rate * options.slow);
  // Rounding errors in the sum of time steps must not lose the last frame.
  constexpr double kSlack = 1e-6;
  const double count = std::floor(end / apart + kSlack) + 1;
  constexpr double kMost = 1e6;  // more must be a typing error in the frame rate
  if (options.frames == 0 && count > kMost)
    throw InputError(
        fmt::format("animation: {:g} s at {:g} frames per second make {:g} frames; set a lower "
                    "frame_rate or "
                    "frames",
                    end * options.slow, options.frame_rate, count));
  std::vector<double> times(static_cast<std::size_t>(
      options.frames == 0 ? count : std::min<double>(count, options.frames)));
  for (std::size_t k = 0; k < times.size(); ++k) times[k] = static_cast<double>(k) * apart;
  return times;
}

std::string count_text(double count) {
  for (const auto& [unit, name] : {std::pair{1e9, "billion"}, {1e6, "million"}})
    if (count >= unit) return fmt::format("{:.3g} {}", count / unit, name);
  return fmt::format("{:.0f}", count);
}

std::vector<Colour> part_colours(const LodAsset& asset) {
  std::vector<Colour> colours;
  for (const std::uint32_t material : part_materials(asset))
    colours.push_back(drawn_colour(asset.chain.levels[0].model.materials, material));
  return colours;
}

/// What all frames of one panel share.
render::Panel panel_frame(const DrawnRun& drawn) {
  const auto& [asset, comparison] = drawn.chain;
  const sim::LevelRuns& runs = drawn.runs;
  const MassSpringModel& model = asset.chain.levels[runs.level].model;
  render::Panel panel;
  panel.title = fmt::format("{}: {} node{}, {} spring{}", runs.label, model.node_count(),
                            model.node_count() == 1 ? "" : "s", model.spring_count(),
                            model.spring_count() == 1 ? "" : "s");
  const auto updates = static_cast<double>(runs.first.spring_updates);
  const auto of_base = static_cast<double>(comparison.levels[0].first.spring_updates);
  if (updates > 0 && &runs == &comparison.levels[0])
    panel.captions.push_back(count_text(updates) + " spring updates");
  else if (updates > 0 && of_base >= updates)
    panel.captions.push_back(fmt::format("{:.1f}x fewer spring updates", of_base / updates));
  else if (updates > 0 && of_base > 0)
    panel.captions.push_back(fmt::format("{:.1f}x more spring updates", updates / of_base));
  if (&runs != &comparison.levels[0] && !runs.starts.empty() && runs.starts[0].surface_error > 0)
    panel.captions.push_back(
        "mean error " +
        format_quantity(std::stod(fmt::format("{:.2g}", runs.starts[0].surface_error)),
                        Dimension::length));
  for (const sim::Obstacle& obstacle : comparison.scenario.obstacles) {
    if (const auto* plane = std::get_if<sim::Plane>(&obstacle.shape))
      panel.planes.push_back({plane->normal, plane->offset});
    else if (const auto* box = std::get_if<sim::SolidBox>(&obstacle.shape))
      panel.boxes.push_back({box->center, box->half_size, box->rotation});
  }
  return panel;
}

/// Largest extent of the surface beyond the nodes at rest [m].
double surface_margin(const LodAsset& asset) {
  if (asset.surface.positions.empty()) return 0;
  const Box3 nodes = bounds(asset.chain.levels[0].model.rest);
  const Box3 surface = bounds(asset.surface);
  return std::max(
      {0., (nodes.min() - surface.min()).maxCoeff(), (surface.max() - nodes.max()).maxCoeff()});
}

/// Bounds of the whole motion, with the floor below it and nearby walls and boxes.
Box3 action_bounds(const std::vector<DrawnRun>& drawn, const std::vector<double>& times) {
  Box3 box;
  double beyond = 0;
  for (const auto& [chain, runs] : drawn) {
    for (const double t : times) box.extend(bounds(positions_at(runs.base_frames, t)));
    beyond = std::max(beyond, surface_margin(chain.asset));
  }
  const Vec3 margin = Vec3::Constant(beyond);
  box.min() -= margin;
  box.max() += margin;
  constexpr double kNear = 0.5;  // fraction of the size of the motion
  const double near = kNear * box.diagonal().norm();
  const Box3 action = box;
  for (const sim::Obstacle& obstacle : drawn.front().chain.comparison.scenario.obstacles) {
    if (const auto* plane = std::get_if<sim::Plane>(&obstacle.shape)) {
      const double height = plane->normal.dot(action.center()) - plane->offset;
      const Vec3 foot = action.center() - height * plane->normal;
      if (action.exteriorDistance(foot) <= near) box.extend(foot);
    } else if (const auto* solid = std::get_if<sim::SolidBox>(&obstacle.shape)) {
      Box3 around;
      for (int i = 0; i < 8; ++i) {
        const Vec3 sign((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
        around.extend(solid->center + solid->rotation * sign.cwiseProduct(solid->half_size));
      }
      // Only the near part of a large box, such as a slab used as floor.
      const Box3 seen(action.min() - Vec3::Constant(near), action.max() + Vec3::Constant(near));
      const Box3 part = around.intersection(seen);
      if (!part.isEmpty()) box.extend(part);
    }
  }
  return box;
}

double facing(const sim::Obstacle& obstacle, double azimuth) {
  const auto* plane = std::get_if<sim::Plane>(&obstacle.shape);
  if (plane == nullptr) return 1;
  const Vec3 across(plane->normal.x(), plane->normal.y(), 0);
  constexpr double kWall = 0.7;  // cosine; floors and ramps never hide the motion
  if (across.norm() < kWall * plane->normal.norm()) return 1;
  const double angle = azimuth * std::numbers::pi / 180;
  return across.normalized().dot(Vec3(std::cos(angle), std::sin(angle), 0));
}

/// The azimuth, or one of its mirror images, from which no wall hides the motion.
double azimuth_of(const sim::Scenario& scenario, const AnimateOptions& options) {
  if (!options.avoid_walls) return options.azimuth;
  const double az = options.azimuth;
  double best = az;
  double best_facing = -2;
  for (const double candidate : {az, -180 - az, -az, 180 + az}) {
    double worst = 1;
    for (const sim::Obstacle& obstacle : scenario.obstacles)
      worst = std::min(worst, facing(obstacle, candidate));
    constexpr double kEnough = 0.15;  // cosine; excludes views along the wall
    if (worst >= kEnough) return candidate;
    if (worst > best_facing) {
      best_facing = worst;
      best = candidate;
    }
  }
  return best;
}

/// A camera that keeps the body of the run in the middle, one per frame.
std::vector<render::Camera> following_cameras(const DrawnRun& drawn,
                                              const std::vector<double>& times,
                                              const AnimateOptions& options) {
  const auto& [asset, comparison] = drawn.chain;
  const sim::LevelRuns& runs = drawn.runs;
  const double aspect = static_cast<double>(options.width) / options.height;
  const double azimuth = azimuth_of(comparison.scenario, options);
  const MassSpringModel& base = asset.chain.levels[0].model;
  std::vector<Vec3> path;
  for (const double t : times)
    path.push_back(center_of_mass(base, positions_at(runs.base_frames, t)));
  constexpr double kSmooth = 0.12;  // to both sides [s of the video]
  const std::vector<Vec3> centers = path;
  // Three box filters are close to a Gaussian one: no kink where the body bounces.
  for (int pass = 0; pass < 3; ++pass)
    path = smoothed(path, static_cast<std::uint32_t>(kSmooth * options.frame_rate));
  // A ball that contains the body in every orientation, with space for labels and surroundings.
  const Vec3 center = center_of_mass(base, base.rest);
  double radius = 0;
  for (const Vec3& p : base.rest) radius = std::max(radius, (p - center).norm());
  double behind = 0;  // largest distance of the body from the middle of the view
  for (std::size_t k = 0; k < path.size(); ++k)
    behind = std::max(behind, (path[k] - centers[k]).norm());
  constexpr double kRoom = 1.5;
  const Vec3 half = Vec3::Constant(
      std::max(kRoom * (radius + surface_margin(asset)), radius + behind) / std::sqrt(3.));
  std::vector<render::Camera> cameras;
  for (const Vec3& p : path)
    cameras.push_back(
        render::frame_box(Box3(p - half, p + half), azimuth, options.elevation, aspect));
  return cameras;
}

/// The cameras of each run, one per frame.
std::vector<std::vector<render::Camera>> cameras_of(const std::vector<DrawnRun>& drawn,
                                                    const std::vector<double>& times,
                                                    const AnimateOptions& options) {
  std::vector<std::vector<render::Camera>> cameras;
  if (options.camera == CameraMode::follow) {
    for (const DrawnRun& run : drawn) cameras.push_back(following_cameras(run, times, options));
    return cameras;
  }
  const double aspect = static_cast<double>(options.width) / options.height;
  const render::Camera fixed = render::frame_box(
      action_bounds(drawn, times), azimuth_of(drawn.front().chain.comparison.scenario, options),
      options.elevation, aspect);
  cameras.assign(drawn.size(), std::vector<render::Camera>(times.size(), fixed));
  return cameras;
}

render::DrawStyle style_for(const LodAsset& asset, render::DrawStyle style) {
  if (asset.surface.triangles.empty()) style.surface = false;
  if (!style.surface && !style.nodes && !style.springs && !style.bold_inner_nodes)
    style.nodes = style.springs = true;
  return style;
}

/// One panel of the animation; owns the data that the drawn body points to.
class PanelPlayer {
 public:
  PanelPlayer(const DrawnRun& drawn, std::vector<render::Camera> cameras,
              const render::DrawStyle& style)
      : asset_(drawn.chain.asset),
        runs_(drawn.runs),
        panel_(panel_frame(drawn)),
        cameras_(std::move(cameras)) {
    body_.style = style_for(asset_, style);
    body_.model = &asset_.chain.levels[runs_.level].model;
    if (!body_.style.surface) return;
    body_.surface = &asset_.surface;
    body_.part_colours = part_colours(asset_);
  }

  render::Panel at(std::size_t picture, double t) {
    nodes_ = positions_at(runs_.first.frames, t);
    body_.node_positions = &nodes_;
    if (body_.surface != nullptr) {
      surface_ = interpolate(asset_.surface_of_base, positions_at(runs_.base_frames, t));
      body_.surface_positions = &surface_;
    }
    render::Panel panel = panel_;
    panel.camera = cameras_[picture];
    panel.bodies = {body_};
    return panel;
  }

 private:
  const LodAsset& asset_;
  const sim::LevelRuns& runs_;
  render::Panel panel_;
  std::vector<render::Camera> cameras_;
  render::DrawnBody body_;
  std::vector<Vec3> nodes_;
  std::vector<Vec3> surface_;
};

/// Removes frame_*.png numbered `count` and up, which would otherwise end up in the video.
void remove_stale_frames(const fs::path& folder, std::size_t count) {
  constexpr std::string_view kBefore = "frame_";
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() != ".png" || !stem.starts_with(kBefore)) continue;
    const std::string digits = stem.substr(kBefore.size());
    constexpr std::size_t kMostDigits = 9;
    if (digits.empty() || digits.size() > kMostDigits ||
        digits.find_first_not_of("0123456789") != std::string::npos)
      continue;
    if (std::stoul(digits) < count) continue;
    std::error_code error;
    fs::remove(entry.path(), error);
    if (error)
      throw IoError(
          fmt::format("cannot remove the old {}: {}", entry.path().string(), error.message()));
  }
}

}  // namespace

Animation animate(const std::vector<ComparedChain>& chains, const fs::path& folder,
                  const AnimateOptions& options) {
  const std::vector<DrawnRun> drawn = drawn_runs(chains, options.levels);
  require_sane(options);
  const std::vector<double> times = picture_times(drawn, options);
  const std::vector<std::vector<render::Camera>> cameras = cameras_of(drawn, times, options);

  Task task(options.progress, "drawing frames", times.size());
  render::FrameWriter writer;
  std::atomic<std::size_t> next{0};
  const auto draw = [&](std::uint64_t, const std::function<bool()>& stopped) {
    try {
      render::Renderer renderer({.panel_width = options.width,
                                 .panel_height = options.height,
                                 .panel_count = static_cast<std::uint32_t>(drawn.size())});
      std::vector<PanelPlayer> players;
      for (std::size_t i = 0; i < drawn.size(); ++i)
        players.emplace_back(drawn[i], cameras[i], options.style);
      for (std::size_t k = next++; k < times.size() && !stopped(); k = next++) {
        std::vector<render::Panel> panels;
        for (PanelPlayer& player : players) panels.push_back(player.at(k, times[k]));
        writer.write(
            renderer.draw(std::move(panels), {.footer = fmt::format("t = {:.3f} s", times[k])}),
            render::frame_path(folder, static_cast<std::uint32_t>(k)), k);
        task.advance();
      }
    } catch (...) {
      writer.abandon(std::current_exception());
      throw;
    }
  };
  // Two contexts keep two cores busy: one draws while the other waits for its pixels. More would
  // only share the rasterizer's threads. A short animation is not worth a second context.
  constexpr std::size_t kFramesOfContext = 8;
  const std::uint32_t painters = times.size() < 2 * kFramesOfContext ? 1 : 2;
  run_jobs(painters, painters, draw);
  writer.finish();
  remove_stale_temporaries(folder);
  remove_stale_frames(folder, times.size());
  return {static_cast<std::uint32_t>(times.size()), folder};
}

}  // namespace springlod::report
