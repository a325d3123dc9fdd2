// Single starts, and the deviation of a level's run from the base's run.

#include "sim/study/deviation.hpp"

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "lod/transfer.hpp"
#include "scripting/bind/tables/scenario_table.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "sim/study/compare.hpp"

namespace springlod::scripting {

namespace {

constexpr const char* kGroup = "Simulation";

int jittered_binding(Call& call) {
  auto scenario = std::make_shared<sim::Scenario>(*scenario_argument(call, 1));
  const MassSpringModel& model = *call.value<ModelValue>(2)->model;
  sim::CompareOptions options;
  options.seed = call.session().settings().seed;
  std::uint32_t number = 1;
  TableReader reader = call.options(3);
  reader.read("number", number);
  reader.read("jitter", options.jitter);
  if (!(options.jitter >= 0 && options.jitter < 1)) reader.refuse("jitter", "in [0, 1)");
  reader.read("seed", options.seed);
  reader.finish();
  scenario->start = sim::jittered(scenario->start, center_of_mass(model, model.rest),
                                  options.jitter, options.seed, number - 1);
  return call.give(std::shared_ptr<const sim::Scenario>(scenario));
}

/// The run's frames as those of the base of its chain.
std::vector<sim::Frame> brought_back(const TrajectoryValue& run) {
  if (run.model->level == 0) return run.trajectory.frames;
  const Binding binding = lod::base_from_level(run.model->chain->chain, run.model->level);
  std::vector<sim::Frame> frames;
  frames.reserve(run.trajectory.frames.size());
  for (const sim::Frame& frame : run.trajectory.frames)
    frames.push_back({frame.time, interpolate(binding, frame.x)});
  return frames;
}

int deviation_binding(Call& call) {
  const auto run = call.value<TrajectoryValue>(1);
  const auto base = call.value<TrajectoryValue>(2);
  const MassSpringModel& reference = *base->model->model;
  const std::size_t nodes = run->model->level == 0
                                ? run->model->model->node_count()
                                : run->model->chain->chain.levels[0].model.node_count();
  if (nodes != reference.node_count())
    throw InputError(
        fmt::format("deviation: the first run has {} nodes at level 0, the second has {}; pass a "
                    "run of a level and a run of its base",
                    nodes, reference.node_count()));
  const std::vector<sim::Deviation> deviations =
      sim::deviation_over_time(brought_back(*run), base->trajectory.frames, reference.mass);
  lua_State* L = call.lua();
  begin_list(L, deviations.size());
  std::size_t number = 0;
  for (const sim::Deviation& deviation : deviations) {
    begin_table(L);
    set_field(L, "time", deviation.time);
    set_field(L, "surface", deviation.surface);
    set_field(L, "shape", deviation.shape);
    end_list_entry(L, ++number);
  }
  return 1;
}

}  // namespace

void describe_deviation(Api& api) {
  const sim::CompareOptions usual;
  api.add(FunctionEntry{
      .name = "jittered",
      .group = kGroup,
      .summary =
          "Returns the scenario with one start of compare or ensemble, to run that start alone.",
      .arguments = {scenario_parameter(),
                    {.name = "model",
                     .type = "Model",
                     .help = "model whose centre of mass is used if the start has no position"}},
      .options = {{.name = "number",
                   .type = "integer",
                   .range = Range{1, 1e9},
                   .fallback = "1",
                   .help = "number of the start; the first is the scenario's own"},
                  {.name = "jitter",
                   .type = "number",
                   .range = Range{0, 1},
                   .fallback = fmt::format("{}", usual.jitter),
                   .help = "relative random change of speed and height, as in compare"},
                  {.name = "seed",
                   .type = "integer",
                   .fallback = "s.seed",
                   .help = "seed of the jitter, as in compare"}},
      .returns = "Scenario",
      .errors = "A jitter outside [0, 1).",
      .example = "local seventh = s.run(chain[1], s.jittered(scene, chain[0], {number = 7}))",
      .call = jittered_binding});
  api.add(FunctionEntry{
      .name = "deviation",
      .group = kGroup,
      .summary = "Distance of a level's run from a run of its base, frame by frame.",
      .arguments = {{.name = "run",
                     .type = "Trajectory",
                     .help = "trajectory of a level of a chain, interpolated to level 0, or of the "
                             "base with other options"},
                    {.name = "base", .type = "Trajectory", .help = "trajectory of the base"}},
      .returns = "list of tables: time [s], surface (mass-weighted rms distance of the level-0 "
                 "nodes [m]), shape (the same after the best rigid fit [m]), as long as both runs "
                 "have frames at the same times",
      .errors = "Runs of bodies with different numbers of nodes at level 0.",
      .example = "local far = s.deviation(s.run(chain[1], scene), s.run(chain[0], scene))\n"
                 "print(far[#far].time, far[#far].surface)",
      .call = deviation_binding});
}

}  // namespace springlod::scripting
