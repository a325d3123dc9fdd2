#include "report/filmed_run.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/message.hpp"
#include "base/units.hpp"
#include "model/drawn_colour.hpp"
#include "report/part_materials.hpp"

namespace springlod::report {
namespace {

void require_frames(const std::string& label, const std::vector<sim::Frame>& frames,
                    std::uint32_t nodes) {
  if (frames.empty())
    throw InputError(
        fmt::format("animation: \"{}\" kept no frames; run it with a frame rate", label));
  for (const sim::Frame& frame : frames)
    if (frame.x.size() != nodes)
      throw InputError(
          fmt::format("animation: \"{}\" has {} positions a frame where the asset "
                      "has {} nodes; is it from another asset?",
                      label, frame.x.size(), nodes));
}

void require_matching(const ComparedChain& chain) {
  const auto& [asset, comparison] = chain;
  if (comparison.levels.empty()) throw InputError("animation: the comparison has no runs");
  const std::vector<Level>& levels = asset.chain.levels;
  for (const sim::LevelRuns& runs : comparison.levels) {
    if (runs.level >= levels.size())
      throw InputError(fmt::format("animation: \"{}\" is of level {}, but the asset has {} levels",
                                   runs.label, runs.level, levels.size()));
    require_frames(runs.label, runs.first.frames, levels[runs.level].model.node_count());
    require_frames(runs.label, runs.base_frames, levels[0].model.node_count());
  }
}

std::string count_text(double count) {
  for (const auto& [unit, name] : {std::pair{1e9, "billion"}, {1e6, "million"}})
    if (count >= unit) return fmt::format("{:.3g} {}", count / unit, name);
  return fmt::format("{:.0f}", count);
}

std::string title_of(const std::string& label, const MassSpringModel& model) {
  return fmt::format("{}{}{}, {}", label, label.empty() ? "" : ": ",
                     counted(model.node_count(), "node"), counted(model.spring_count(), "spring"));
}

std::vector<std::string> cost_captions(double updates) {
  if (!(updates > 0)) return {};
  return {count_text(updates) + " spring updates"};
}

/// The error of the first start, with the time until which it is averaged: bodies that roll or
/// topple later are farther apart in the film.
std::string error_caption(double error, std::optional<double> end) {
  const std::string rounded =
      format_quantity(std::stod(fmt::format("{:.2g}", error)), Dimension::length);
  return end ? fmt::format("error {} until t = {:.2f} s", rounded, *end) : "mean error " + rounded;
}

/// Cost and error of a level, relative to the base.
std::vector<std::string> captions_of(const sim::LevelRuns& runs,
                                     const sim::Comparison& comparison) {
  const sim::LevelRuns& base = comparison.levels.front();
  const auto updates = static_cast<double>(runs.first.spring_updates);
  if (&runs == &base) return cost_captions(updates);
  std::vector<std::string> captions;
  const auto of_base = static_cast<double>(base.first.spring_updates);
  if (updates > 0 && of_base >= updates)
    captions.push_back(fmt::format("{:.1f}x fewer spring updates", of_base / updates));
  else if (updates > 0 && of_base > 0)
    captions.push_back(fmt::format("{:.1f}x more spring updates", updates / of_base));
  if (!runs.starts.empty() && runs.starts[0].surface_error > 0)
    captions.push_back(error_caption(runs.starts[0].surface_error, sim::error_end(comparison)));
  return captions;
}

std::vector<Colour> part_colours(const TriangleMesh& surface, const Binding& surface_of_body,
                                 const MassSpringModel& body) {
  std::vector<Colour> colours;
  for (const std::uint32_t material : part_materials(surface, surface_of_body, body))
    colours.push_back(drawn_colour(body.materials, material));
  return colours;
}

/// Gives the body its surface; a mesh without triangles is none.
void cover(FilmedRun& run, const TriangleMesh& surface, const Binding& surface_of_body) {
  if (surface.triangles.empty()) return;
  run.surface = &surface;
  run.surface_of_body = surface_of_body;
  run.part_colours = part_colours(surface, surface_of_body, run.body);
}

FilmedRun filmed_level(const ComparedChain& chain, const sim::LevelRuns& runs) {
  const auto& [asset, comparison] = chain;
  const MassSpringModel& model = asset.chain.levels[runs.level].model;
  FilmedRun run{.label = runs.label,
                .title = title_of(runs.label, model),
                .captions = captions_of(runs, comparison),
                .scenario = comparison.scenario,
                .model = model,
                .frames = runs.first.frames,
                .anchored = runs.first.anchored,
                .body = asset.chain.levels.front().model,
                .body_frames = runs.base_frames};
  cover(run, asset.surface, asset.surface_of_base);
  return run;
}

}  // namespace

std::vector<FilmedRun> filmed_runs(const std::vector<ComparedChain>& chains,
                                   const std::vector<std::uint32_t>& levels) {
  std::vector<FilmedRun> filmed;
  for (const ComparedChain& chain : chains) {
    require_matching(chain);
    for (const sim::LevelRuns& runs : chain.comparison.levels) {
      const bool again = runs.level == 0 && &chain != chains.data();
      const bool chosen =
          levels.empty() || std::find(levels.begin(), levels.end(), runs.level) != levels.end();
      if (chosen && !again) filmed.push_back(filmed_level(chain, runs));
    }
  }
  if (filmed.empty()) throw InputError("animation: levels has none of the levels of the runs");
  return filmed;
}

std::vector<FilmedRun> filmed_runs(const std::vector<LabelledRun>& runs) {
  std::vector<FilmedRun> filmed;
  for (const LabelledRun& run : runs) {
    const std::vector<sim::Frame>& frames = run.trajectory.frames;
    require_frames(run.label, frames, run.model.node_count());
    filmed.push_back({.label = run.label,
                      .title = title_of(run.label, run.model),
                      .captions = cost_captions(static_cast<double>(run.trajectory.spring_updates)),
                      .scenario = run.scenario,
                      .model = run.model,
                      .frames = frames,
                      .anchored = run.trajectory.anchored,
                      .body = run.model,
                      .body_frames = frames});
    if (run.surface != nullptr) cover(filmed.back(), *run.surface, run.surface_of_nodes);
  }
  return filmed;
}

}  // namespace springlod::report
