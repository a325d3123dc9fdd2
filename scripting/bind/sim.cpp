// Running one model under a scenario.

#include <fmt/format.h>
#include <lua.hpp>

#include "base/message.hpp"
#include "base/script_number.hpp"
#include "scripting/bind/tables/anchor_table.hpp"
#include "scripting/bind/tables/options.hpp"
#include "scripting/bind/tables/run_options.hpp"
#include "scripting/bind/tables/scenario_table.hpp"
#include "scripting/bind/tables/start_overlap.hpp"
#include "scripting/bind/tables/start_table.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "sim/run.hpp"

namespace springlod::scripting {

namespace {

constexpr const char* kGroup = "Simulation";

/// The base of the chain of a level; a model without a chain is its own.
const MassSpringModel& base_of(const ModelValue& model) {
  return model.chain ? model.chain->chain.levels.front().model : *model.model;
}

/// Warnings about a run that completed.
void warn(Session& session, const ModelValue& model, const sim::Trajectory& run, bool resisted) {
  Console& console = session.console();
  if (run.limited_by == sim::StepBound::damping && first_hint_at_damping(session, base_of(model)))
    console.say("run: damping shortens the step " + damping_hint(run));
  if (run.unconverged_steps > 0)
    console.say(
        fmt::format("run: in {} of {} the solver did not reach its tolerance; use more "
                    "iterations, a greater tolerance or a smaller step",
                    run.unconverged_steps, counted(run.steps, "step")));
  if (run.first_crossing)
    console.say(fmt::format(
        "run: the spring of nodes {} and {} was inverted by t = {:.4g} s (its nodes crossed); {}",
        script_number(run.first_crossing->a), script_number(run.first_crossing->b),
        run.first_crossing->time, inversion_hint(resisted)));
  if (const auto& first = run.inversions.first)
    console.say(fmt::format(
        "run: the body was inside out at t = {:.4g} s, at ({:.4g}, {:.4g}, {:.4g}) m (corner {}); "
        "at most {} at one time, {} at the end; {}",
        first->time, first->place.x(), first->place.y(), first->place.z(),
        script_number(first->corner), counted(run.inversions.most, "corner"), run.inverted_at_end,
        inversion_hint(resisted)));
}

int run_binding(Call& call) {
  auto value = std::make_shared<TrajectoryValue>();
  value->model = call.value<ModelValue>(1);
  value->scenario = scenario_argument(call, 2);
  sim::RunOptions options;
  options.threads = call.session().settings().threads;
  TableReader reader = call.options(3);
  read_options(call, reader, options);
  options.progress = call.progress();
  options.skin = skin_of(*value->model, read_contact(reader));
  reader.read("threads", options.threads);
  bool quiet = false;
  reader.read("quiet", quiet);
  const MassSpringModel& model = *value->model->model;
  const std::optional<State> start = read_start(call, reader, model);
  options.anchors = read_anchors(call, reader, model);
  for (const sim::Anchor& anchor : options.anchors) value->anchor_names.push_back(anchor.name);
  reader.finish();
  if (!quiet && !start)
    if (const auto text = overlap_warning("run", model, *value->scenario))
      call.session().console().say(*text);
  value->trajectory = start ? sim::run(model, *value->scenario, *start, options)
                            : sim::run(model, *value->scenario, options);
  if (!quiet)
    warn(call.session(), *value->model, value->trajectory, sim::corners_resist(model, options));
  return call.give(std::shared_ptr<const TrajectoryValue>(value));
}

void push_frame(lua_State* L, const sim::Frame& frame) {
  begin_table(L);
  set_field(L, "time", frame.time);
  set_field(L, "x", frame.x);
}

int frame_method(Call& call) {
  const auto self = call.self<TrajectoryValue>();
  const auto& frames = self->trajectory.frames;
  push_frame(call.lua(), frames[static_cast<std::size_t>(
                             call.integer(1, 1, static_cast<long long>(frames.size())) - 1)]);
  return 1;
}

void push_ledger(lua_State* L, const TrajectoryValue& value) {
  begin_list(L, value.trajectory.ledger.size());
  std::size_t number = 0;
  for (const sim::LedgerEntry& entry : value.trajectory.ledger) {
    begin_table(L);
    set_field(L, "time", entry.time);
    set_field(L, "kinetic", entry.kinetic);
    set_field(L, "elastic", entry.elastic);
    set_field(L, "gravity", entry.gravity);
    set_field(L, "contact", entry.contact);
    set_field(L, "anchors", entry.anchors);
    set_field(L, "lost_damping", entry.lost_damping);
    set_field(L, "lost_friction", entry.lost_friction);
    set_field(L, "lost_contact", entry.lost_contact);
    set_field(L, "lost_corners", entry.lost_corners);
    set_field(L, "lost_anchors", entry.lost_anchors);
    set_field(L, "lost_scheme", entry.lost_scheme);
    set_field(L, "lost_switch", entry.lost_switch);
    set_field(L, "anchor_work", entry.anchor_work);
    set_field(L, "total", entry.total());
    end_list_entry(L, ++number);
  }
}

void push_final(lua_State* L, const TrajectoryValue& value) {
  begin_table(L);
  set_field(L, "time", value.trajectory.final.t);
  set_field(L, "x", value.trajectory.final.x);
  set_field(L, "v", value.trajectory.final.v);
}

void push_crossing(lua_State* L, const TrajectoryValue& value) {
  const auto& crossing = value.trajectory.first_crossing;
  if (!crossing) return lua_pushnil(L);
  begin_table(L);
  set_field(L, "a", crossing->a + 1);
  set_field(L, "b", crossing->b + 1);
  set_field(L, "time", crossing->time);
}

void push_inversion(lua_State* L, const TrajectoryValue& value) {
  const auto& inversion = value.trajectory.inversions.first;
  if (!inversion) return lua_pushnil(L);
  begin_table(L);
  set_field(L, "corner", inversion->corner + 1);
  set_field(L, "node", value.model->model->corners[inversion->corner].node[0] + 1);
  set_field(L, "position", inversion->place);
  set_field(L, "time", inversion->time);
}

void push_optional(lua_State* L, const std::optional<double>& number) {
  number ? push(L, *number) : lua_pushnil(L);
}

void describe_trajectory(Api& api) {
  TypeBuilder<TrajectoryValue> type(
      "One run of one model; trajectory[i] is frame i, #trajectory their number.",
      [](const TrajectoryValue& value) {
        const sim::Trajectory& t = value.trajectory;
        return fmt::format("Trajectory: {:.4g} s in {} of {:.4g} s, {}", t.simulated,
                           counted(t.steps, "step"), t.step, counted(t.frames.size(), "frame"));
      });
  const auto number = [&](const char* name, const char* help, auto get) {
    type.field(name, "number", help,
               [get](const TrajectoryValue& value) { return get(value.trajectory); });
  };
  number("step", "time step of the body at rest [s]",
         [](const sim::Trajectory& t) { return t.step; });
  number("shortest_step", "shortest time step, while the body was strongly strained [s]",
         [](const sim::Trajectory& t) { return t.shortest_step; });
  number("predicted_step", "predicted stable step, contacts included [s]",
         [](const sim::Trajectory& t) { return t.predicted_step; });
  number("undamped_step", "predicted stable step without damping [s]",
         [](const sim::Trajectory& t) { return t.undamped_step; });
  type.choice_field("limited_by", "what determines step",
                    [](const TrajectoryValue& value) { return value.trajectory.limited_by; });
  number("simulated", "simulated time [s]", [](const sim::Trajectory& t) { return t.simulated; });
  number("wall_seconds", "measured wall time; not reproducible [s]",
         [](const sim::Trajectory& t) { return t.wall_seconds; });
  number("planning_seconds", "part of wall_seconds before the first step [s]",
         [](const sim::Trajectory& t) { return t.planning_seconds; });
  number("processor_seconds",
         "measured processor time of the calling thread from the first step on [s]",
         [](const sim::Trajectory& t) { return t.processor_seconds; });
  type.field("steps", "integer", "number of steps",
             [](const TrajectoryValue& value) { return value.trajectory.steps; });
  type.field("unconverged_steps", "integer",
             "steps in which the solver of backward Euler did not reach its tolerance",
             [](const TrajectoryValue& value) { return value.trajectory.unconverged_steps; });
  type.field("spring_updates", "integer",
             "spring evaluations in all steps: a cost that does not depend on the machine",
             [](const TrajectoryValue& value) { return value.trajectory.spring_updates; });
  type.field("frame_count", "integer", "number of frames",
             [](const TrajectoryValue& value) { return value.trajectory.frames.size(); });
  type.table_field("first_contact", "number", "time of the first contact [s], or nil",
                   [](lua_State* L, const TrajectoryValue& value) {
                     push_optional(L, value.trajectory.first_contact);
                   });
  type.table_field("asleep_since", "number", "time since which the body sleeps [s], or nil",
                   [](lua_State* L, const TrajectoryValue& value) {
                     push_optional(L, value.trajectory.asleep_since);
                   });
  type.table_field("first_crossing", "table",
                   "first crossing: nodes a and b of the spring (from 1) and time [s]; or nil",
                   push_crossing);
  type.table_field("first_inversion", "table",
                   "first corner inside out: corner, its node (both from 1), position [m] and time "
                   "[s]; or nil",
                   push_inversion);
  type.field("most_inverted", "integer", "largest number of corners inside out at one time",
             [](const TrajectoryValue& value) { return value.trajectory.inversions.most; });
  type.field("inverted_at_end", "integer", "corners inside out in the last state",
             [](const TrajectoryValue& value) { return value.trajectory.inverted_at_end; });
  type.table_field(
      "ledger", "list of tables",
      "energies of each frame [J]: time, kinetic, elastic, gravity, contact, anchors (in their "
      "springs), lost_damping, lost_friction, lost_contact, lost_corners, lost_anchors, "
      "lost_scheme, lost_switch, "
      "anchor_work (done on the body by what holds it), total",
      push_ledger);
  type.table_field(
      "anchor_loads", "list of tables",
      "what each anchor does to the body, frame by frame, in their order: name, force [N] and "
      "torque about its pivot [N m] (means since the frame before), work since the start [J]",
      push_anchor_loads);
  type.table_field("final", "State", "last state: time [s], x and v, lists of {x, y, z} by node",
                   push_final);
  type.method(
      {.name = "frame",
       .summary = "One frame; the same as trajectory[number].",
       .arguments = {{.name = "number", .type = "integer", .help = "number of the frame, from 1"}},
       .returns = "table: time [s], x (list of {x, y, z} by node) [m]",
       .call = frame_method});
  type.elements(
      [](const TrajectoryValue& value) {
        return static_cast<long long>(value.trajectory.frames.size());
      },
      [](lua_State* L, const std::shared_ptr<const TrajectoryValue>& value, long long frame) {
        const auto& frames = value->trajectory.frames;
        if (frame < 1 || frame > static_cast<long long>(frames.size())) return false;
        push_frame(L, frames[static_cast<std::size_t>(frame - 1)]);
        return true;
      });
  api.add(type.build());
}

std::vector<Parameter> single_run_parameters() {
  std::vector<Parameter> parameters = parameters_of<sim::RunOptions>();
  parameters.push_back(contact_parameter());
  parameters.push_back(start_parameter());
  parameters.push_back(anchors_parameter());
  parameters.push_back(
      {.name = "threads",
       .type = "integer",
       .range = Range{0, 1024},
       .fallback = "s.threads",
       .help = "threads of symplectic_euler; 0: chosen by model size; never changes a result"});
  parameters.push_back(
      {.name = "quiet",
       .type = "boolean",
       .fallback = "false",
       .help =
           "suppress warnings about damping, unconverged steps and inversions; the Trajectory has "
           "them"});
  return parameters;
}

}  // namespace

void describe_sim(Api& api) {
  describe_scenario(api);
  describe_start(api);
  describe_anchors(api);
  describe_trajectory(api);
  describe_stability(api);
  api.add(FunctionEntry{
      .name = "run",
      .group = kGroup,
      .summary = "Runs a model under a scenario.",
      .arguments = {{.name = "model", .type = "Model", .help = "a model or a level of a chain"},
                    scenario_parameter()},
      .options = single_run_parameters(),
      .returns = "Trajectory",
      .errors = "A diverged run: error.kind is \"unstable\"; error.node and error.time are its "
                "node and time. A node that passes through a box: \"tunnelled\"; error.obstacle "
                "names the box. A start with another number of nodes. Anchors without nodes, two "
                "that hold one node, a path whose times do not increase.",
      .example = "local trajectory = s.run(chain[1], scene, {frame_rate = 30})\n"
                 "local more = s.run(chain[1], scene, {start = trajectory.final})\n"
                 "local hung = s.run(base, scene, {anchored = function(node) return node.z > 0.1 "
                 "end})",
      .call = run_binding});
  describe_compare(api);
  describe_deviation(api);
  describe_pick(api);
}

}  // namespace springlod::scripting
