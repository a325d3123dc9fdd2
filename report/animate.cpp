#include "report/animate.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <exception>
#include <functional>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/temporary_file.hpp"
#include "render/frame_writer.hpp"
#include "render/frames.hpp"
#include "report/film_cameras.hpp"
#include "report/playback.hpp"

namespace springlod::report {
namespace {

namespace fs = std::filesystem;

void require_sane(const AnimateOptions& options) {
  const double frame_rate = options.frame_rate.value_or(kUsualFrameRate);
  if (!(frame_rate > 0) || !std::isfinite(frame_rate) || !(options.slow > 0) ||
      !std::isfinite(options.slow))
    throw InputError(fmt::format("animation: frame_rate = {} and slow = {} must be above 0",
                                 frame_rate, options.slow));
}

/// A straight line from the first frame to the last is no motion.
void require_motion(const FilmedRun& run, const std::vector<double>& times) {
  constexpr std::size_t kFirstAndLast = 2;
  if (run.frames.size() > kFirstAndLast) return;
  const auto between = std::count_if(times.begin(), times.end(), [&](double t) {
    return t > run.frames.front().time && t < run.end();
  });
  if (between > 1)
    throw InputError(fmt::format(
        "animation: \"{}\" kept only its first and its last frame; run it with a frame_rate, such "
        "as 60",
        run.label));
}

double end_of(const std::vector<FilmedRun>& runs) {
  double end = 0;
  for (const FilmedRun& run : runs) end = std::max(end, run.end());
  return end;
}

/// The frame rate that was asked for; else the usual one, or a lower one at which the first of the
/// frames shows the start of the runs and the last their end.
double frame_rate_of(const std::vector<FilmedRun>& runs, const AnimateOptions& options) {
  if (options.frame_rate) return *options.frame_rate;
  const double seconds = end_of(runs) * options.slow;
  if (options.frames < 2 || !(seconds > 0)) return kUsualFrameRate;
  return std::clamp((options.frames - 1) / seconds, kLeastFrameRate, kUsualFrameRate);
}

/// Simulated time between two pictures [s].
double time_apart(const AnimateOptions& options) {
  return 1 / (*options.frame_rate * options.slow);
}

/// The times of the frames [s].
std::vector<double> picture_times(const std::vector<FilmedRun>& runs,
                                  const AnimateOptions& options) {
  const double end = end_of(runs);
  const double apart = time_apart(options);
  // Rounding errors in the sum of time steps must not lose the last frame.
  constexpr double kSlack = 1e-6;
  const double count = std::floor(end / apart + kSlack) + 1;
  constexpr double kMost = 1e6;  // more must be a typing error in the frame rate
  if (options.frames == 0 && count > kMost)
    throw InputError(
        fmt::format("animation: {:g} s at {:g} frames per second make {:g} frames; set a lower "
                    "frame_rate or "
                    "frames",
                    end * options.slow, *options.frame_rate, count));
  std::vector<double> times(static_cast<std::size_t>(
      options.frames == 0 ? count : std::min<double>(count, options.frames)));
  for (std::size_t k = 0; k < times.size(); ++k) times[k] = static_cast<double>(k) * apart;
  return times;
}

/// The panel of a run without its bodies and camera, which change from frame to frame.
render::Panel empty_panel(const FilmedRun& run) {
  render::Panel panel;
  panel.title = run.title;
  panel.captions = run.captions;
  for (const sim::Obstacle& obstacle : run.scenario.obstacles) {
    if (const auto* plane = std::get_if<sim::Plane>(&obstacle.shape))
      panel.planes.push_back({plane->normal, plane->offset});
    else if (const auto* box = std::get_if<sim::SolidBox>(&obstacle.shape))
      panel.boxes.push_back({box->center, box->half_size, box->rotation});
  }
  return panel;
}

render::DrawStyle style_for(const FilmedRun& run, render::DrawStyle style) {
  if (run.surface == nullptr) style.surface = false;
  if (!style.surface && !style.nodes && !style.springs && !style.bold_inner_nodes)
    style.nodes = style.springs = true;
  return style;
}

/// One panel of the animation; owns the data that the drawn body points to.
class PanelPlayer {
 public:
  /// `apart`: simulated time between two pictures [s].
  PanelPlayer(const FilmedRun& run, std::vector<render::Camera> cameras, double apart,
              const render::DrawStyle& style)
      : run_(run), apart_(apart), panel_(empty_panel(run)), cameras_(std::move(cameras)) {
    body_.style = style_for(run, style);
    body_.model = &run.model;
    body_.anchored = run.anchored;
    if (!body_.style.surface) return;
    body_.surface = run.surface;
    body_.part_colours = run.part_colours;
  }

  render::Panel at(std::size_t picture, double t) {
    nodes_ = positions_at(run_.frames, t);
    body_.node_positions = &nodes_;
    if (body_.surface != nullptr) {
      surface_ = interpolate(run_.surface_of_body, positions_at(run_.body_frames, t));
      body_.surface_positions = &surface_;
    }
    render::Panel panel = panel_;
    panel.camera = cameras_[picture];
    panel.bodies = {body_};
    // Runs may end a step apart, which is not worth a word.
    if (t > run_.end() + apart_ / 2)
      panel.captions.push_back(fmt::format("ended at t = {:.3f} s, last frame held", run_.end()));
    return panel;
  }

 private:
  const FilmedRun& run_;
  double apart_;
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

Animation animate(const std::vector<FilmedRun>& runs, const fs::path& folder,
                  const AnimateOptions& given) {
  if (runs.empty()) throw InputError("animation: there are no runs to draw");
  require_sane(given);
  AnimateOptions options = given;
  options.frame_rate = frame_rate_of(runs, given);
  const std::vector<double> times = picture_times(runs, options);
  for (const FilmedRun& run : runs) require_motion(run, times);
  const std::vector<std::vector<render::Camera>> cameras = film_cameras(runs, times, options);

  Task task(options.progress, "drawing frames", times.size());
  render::FrameWriter writer;
  std::atomic<std::size_t> next{0};
  const auto draw = [&](std::uint64_t, const std::function<bool()>& stopped) {
    try {
      render::Renderer renderer({.panel_width = options.width,
                                 .panel_height = options.height,
                                 .panel_count = static_cast<std::uint32_t>(runs.size()),
                                 .columns = options.columns});
      std::vector<PanelPlayer> players;
      for (std::size_t i = 0; i < runs.size(); ++i)
        players.emplace_back(runs[i], cameras[i], time_apart(options), options.style);
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
  return {static_cast<std::uint32_t>(times.size()), *options.frame_rate, folder};
}

Animation animate(const std::vector<ComparedChain>& chains, const fs::path& folder,
                  const AnimateOptions& options) {
  return animate(filmed_runs(chains, options.levels), folder, options);
}

}  // namespace springlod::report
