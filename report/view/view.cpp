#include "report/view/view.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/message.hpp"
#include "lod/transfer.hpp"
#include "model/drawn_colour.hpp"
#include "render/scene.hpp"
#include "report/part_materials.hpp"
#include "report/playback.hpp"
#include "report/view/coarse_surface.hpp"
#include "sim/study/compare.hpp"

namespace springlod::report {
namespace {

/// A level of which a body may be made. `runs` is null for a level at rest.
struct Candidate {
  const LodAsset* asset;
  const sim::LevelRuns* runs;
  std::string label;
  std::uint32_t chain, level;

  const MassSpringModel& model() const { return asset->chain.levels[level].model; }
};

// Bytes of text of one number of 8 bits, and of what consists of numbers.
constexpr double kText = 4. / 3;
constexpr double kFrameBytes = 6 * kText;   // a node in a frame
constexpr double kSpringBytes = 4 * kText;  // two ends of 16 bits
constexpr double kEntryBytes = 4 * kText;   // an entry of a row: node and weight
constexpr double kTriangleBytes = 6 * kText;
constexpr std::uint32_t kShortIndex = 65536;  // beyond it, indices take twice as much

double wide(std::size_t count) {
  return count > kShortIndex ? 2 : 1;
}

double row_bytes(const Binding& rows) {
  return kEntryBytes * static_cast<double>(rows.node.size()) +
         kText * static_cast<double>(rows.point_count());
}

/// The rows `which` of a binding.
Binding some_rows(const Binding& rows, const std::vector<std::uint32_t>& which) {
  Binding some;
  some.start.push_back(0);
  for (const std::uint32_t p : which) {
    for (std::uint32_t e = rows.start[p]; e < rows.start[p + 1]; ++e) {
      some.node.push_back(rows.node[e]);
      some.weight.push_back(rows.weight[e]);
    }
    some.start.push_back(static_cast<std::uint32_t>(some.node.size()));
  }
  return some;
}

void add_surface(View& view, const LodAsset& asset, const ViewOptions& options) {
  if (asset.surface.triangles.empty() || asset.surface_of_base.point_count() == 0) return;
  const CoarseSurface surface = coarse_surface(asset.surface, options.triangles);
  view.triangles = surface.triangles;
  view.surface = some_rows(asset.surface_of_base, surface.vertex);
  const std::vector<std::uint32_t> of_part = part_materials(asset);
  for (const std::uint32_t part : surface.part) view.vertex_colour.push_back(of_part[part]);
}

double surface_bytes(const View& view) {
  return row_bytes(view.surface) + static_cast<double>(view.triangles.size()) * kTriangleBytes *
                                       wide(view.vertex_colour.size());
}

void drop_surface(View& view, const char* reason) {
  if (view.triangles.empty()) return;
  view.left_out.push_back(fmt::format("The surface is left out: {}.", reason));
  view.triangles.clear();
  view.vertex_colour.clear();
  view.surface = {};
}

/// The rows of the base's nodes that the surface follows; the rows of the others are empty.
Binding rows_of_surface(const Binding& to_base, const Binding& surface) {
  std::vector<bool> followed(to_base.point_count(), false);
  for (const std::uint32_t node : surface.node) followed[node] = true;
  Binding rows;
  rows.start.push_back(0);
  for (std::uint32_t p = 0; p < to_base.point_count(); ++p) {
    for (std::uint32_t e = to_base.start[p]; followed[p] && e < to_base.start[p + 1]; ++e) {
      rows.node.push_back(to_base.node[e]);
      rows.weight.push_back(to_base.weight[e]);
    }
    rows.start.push_back(static_cast<std::uint32_t>(rows.node.size()));
  }
  return rows;
}

/// A body without frames and without ends of springs. `surface`: rows of the surface, or empty.
ViewBody still_body(const Candidate& candidate, const Binding& surface) {
  const MassSpringModel& model = candidate.model();
  ViewBody body;
  body.label = candidate.label;
  body.chain = candidate.chain;
  body.level = candidate.level;
  body.springs = model.spring_count();
  body.colour = model.material;
  if (surface.point_count() > 0 && candidate.level > 0)
    body.to_base =
        rows_of_surface(lod::base_from_level(candidate.asset->chain, candidate.level), surface);
  return body;
}

/// Motion or rest positions at the times of the view.
void add_frames(ViewBody& body, const Candidate& candidate, const std::vector<double>& times) {
  if (candidate.runs == nullptr) {
    body.frames.push_back(candidate.model().rest);
    return;
  }
  for (const double t : times) body.frames.push_back(positions_at(candidate.runs->first.frames, t));
}

std::vector<double> spread_times(double end, std::size_t count) {
  if (count < 2 || end <= 0) return {0};
  std::vector<double> times(count);
  for (std::size_t k = 0; k < count; ++k)
    times[k] = end * static_cast<double>(k) / static_cast<double>(count - 1);
  return times;
}

/// A level that moves has room for so many frames, or is left out.
constexpr std::uint32_t kLeastFrames = 12;

/// Bytes of the frames that a body of so many nodes should have.
double least_frame_bytes(const std::vector<Candidate>& candidates, const ViewOptions& options,
                         double nodes) {
  const bool moves = candidates.front().runs != nullptr;
  return kFrameBytes * nodes * (moves ? std::min(options.frames, kLeastFrames) : 1);
}

/// The candidates that fit, preferring coarse ones; their order stays.
std::vector<std::size_t> fitting(const std::vector<Candidate>& candidates, View& view,
                                 const ViewOptions& options, double bytes_left) {
  std::vector<std::size_t> order(candidates.size()), kept;
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t k) {
    return candidates[i].model().node_count() < candidates[k].model().node_count();
  });
  for (const std::size_t i : order) {
    const MassSpringModel& model = candidates[i].model();
    const double nodes = model.node_count();
    const double bytes = least_frame_bytes(candidates, options, nodes) + kText * nodes;
    if (bytes > bytes_left) {
      view.left_out.push_back(fmt::format("{} is left out: it has too many nodes ({}).",
                                          candidates[i].label, model.node_count()));
      continue;
    }
    bytes_left -= bytes;
    kept.push_back(i);
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

/// Lists the springs of the bodies, which are of the candidates `kept`, from coarse to fine as long
/// as they fit into `spare` bytes. Returns the bytes that they take.
double list_springs(View& view, const std::vector<Candidate>& candidates,
                    const std::vector<std::size_t>& kept, double spare) {
  double taken = 0;
  std::uint32_t without = 0;
  for (std::size_t b = kept.size(); b-- > 0;) {
    const MassSpringModel& model = candidates[kept[b]].model();
    const double springs = kSpringBytes * wide(model.node_count()) * model.spring_count();
    if (taken + springs > spare) {
      ++without;
      continue;
    }
    taken += springs;
    for (std::uint32_t s = 0; s < model.spring_count(); ++s)
      view.bodies[b].ends.push_back({model.a[s], model.b[s]});
  }
  if (without > 0)
    view.left_out.push_back(
        fmt::format("The springs of {} are left out.", counted(without, "level")));
  return taken;
}

/// Fills the bodies. Half of the bytes are for what does not move, the rest for frames.
void add_bodies(View& view, const std::vector<Candidate>& candidates, double end,
                const ViewOptions& options) {
  double bytes_left = options.bytes;
  if (surface_bytes(view) > options.bytes / 2)
    drop_surface(view, "it takes too many bytes");
  else
    bytes_left -= surface_bytes(view);
  const std::vector<std::size_t> kept = fitting(candidates, view, options, bytes_left);
  if (kept.empty())
    throw InputError(
        fmt::format("view: no level fits into {:.0f} bytes; increase bytes", options.bytes));
  // The surface follows the base's nodes, so it is drawn only if they can be.
  if (kept.front() != 0) drop_surface(view, "the base is");
  double nodes = 0, rows = 0;
  for (const std::size_t i : kept) {
    view.bodies.push_back(still_body(candidates[i], view.surface));
    nodes += candidates[i].model().node_count();
    rows += row_bytes(view.bodies.back().to_base);
  }
  if (rows > bytes_left / 2) {
    drop_surface(view, "its link to the levels takes too many bytes");
    for (ViewBody& body : view.bodies) body.to_base = {};
    rows = 0;
  }
  bytes_left -= rows;
  bytes_left -= kText * nodes;          // colours
  constexpr double kSpringShare = 0.1;  // for springs, even if frames are short
  const double spare = bytes_left - least_frame_bytes(candidates, options, nodes);
  bytes_left -= list_springs(view, candidates, kept, std::max(spare, kSpringShare * bytes_left));
  const double affordable = std::max(1., std::floor(bytes_left / (kFrameBytes * nodes)));
  const bool moves = candidates.front().runs != nullptr;
  const auto count =
      moves ? static_cast<std::size_t>(std::min<double>(options.frames, affordable)) : 1;
  view.times = spread_times(end, count);
  if (moves && count < options.frames)
    view.left_out.push_back(fmt::format("The motion has {} frames.", count));
  const std::size_t triangles = candidates.front().asset->surface.triangles.size();
  if (!view.triangles.empty() && view.triangles.size() < triangles)
    view.left_out.push_back(fmt::format("The surface is drawn with {} of {} triangles.",
                                        view.triangles.size(), triangles));
  for (std::size_t b = 0; b < kept.size(); ++b)
    add_frames(view.bodies[b], candidates[kept[b]], view.times);
}

View view_for(const LodAsset& asset, const ViewOptions& options) {
  View view;
  const std::vector<Material>& materials = asset.chain.levels.at(0).model.materials;
  for (std::uint32_t m = 0; m < materials.size(); ++m)
    view.palette.push_back(drawn_colour(materials, m));
  add_surface(view, asset, options);
  return view;
}

}  // namespace

View view_of(const LodAsset& asset, const ViewOptions& options) {
  View view = view_for(asset, options);
  std::vector<Candidate> candidates;
  for (std::uint32_t n = 0; n < asset.chain.levels.size(); ++n)
    candidates.push_back({&asset, nullptr, sim::level_label(n), 0, n});
  add_bodies(view, candidates, 0, options);
  return view;
}

View view_of(const std::vector<ComparedChain>& chains, const ViewOptions& options) {
  if (chains.empty()) throw InputError("view: there is no comparison");
  const LodAsset& first = chains.front().asset;
  View view = view_for(first, options);
  view.obstacles = chains.front().comparison.scenario.obstacles;
  std::vector<Candidate> candidates;
  double end = 0;
  for (std::uint32_t c = 0; c < chains.size(); ++c) {
    const auto& [asset, comparison] = chains[c];
    if (asset.chain.levels[0].model.rest != first.chain.levels[0].model.rest)
      throw InputError(fmt::format(
          "view: the base of comparison {} is not that of the first; show it in a view of its own",
          c + 1));
    for (const sim::LevelRuns& runs : comparison.levels) {
      if (runs.first.frames.empty())
        throw InputError(
            fmt::format("view: \"{}\" kept no frames; run it with a frame rate", runs.label));
      if (runs.level == 0 && c > 0) continue;
      candidates.push_back({&asset, &runs, runs.label, c, runs.level});
      end = std::max(end, runs.first.frames.back().time);
    }
  }
  if (candidates.empty()) throw InputError("view: the comparison has no runs");
  add_bodies(view, candidates, end, options);
  return view;
}

}  // namespace springlod::report
