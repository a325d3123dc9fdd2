// Elasticity of mass-spring models: measured moduli, zero modes, modes and static loads of free and
// anchored bodies.

#include <string>

#include <fmt/format.h>
#include <lua.hpp>

#include "elastic/large_deflection.hpp"
#include "elastic/loads.hpp"
#include "elastic/modes.hpp"
#include "elastic/moduli.hpp"
#include "elastic/stiffness.hpp"
#include "elastic/zero_modes.hpp"
#include "scripting/bind/tables/anchor_table.hpp"
#include "scripting/bind/tables/node_choice.hpp"
#include "scripting/bind/tables/options.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "sim/held/held_nodes.hpp"

namespace springlod::scripting {

namespace {

constexpr const char* kGroup = "Models";

constexpr Choice<int> kAxisRows[] = {{0, "x", ""}, {1, "y", ""}, {2, "z", ""}};
constexpr ChoiceTable kAxes("axis", kAxisRows);

int stretch_binding(Call& call) {
  const auto value = call.value<ModelValue>(1);
  elastic::StretchOptions options;
  TableReader reader = call.options(2);
  reader.choose("axis", options.axis, kAxes);
  reader.read("cross_section", options.cross_section);
  reader.finish();
  const elastic::StretchResult result = elastic::stretch_test(*value->model, options);
  begin_table(call.lua());
  set_field(call.lua(), "young", result.young);
  set_field(call.lua(), "poisson", result.poisson);
  set_field(call.lua(), "reaction", result.reaction);
  set_field(call.lua(), "strain_energy", result.strain_energy);
  return 1;
}

int zero_modes_binding(Call& call) {
  const MassSpringModel& model = *call.value<ModelValue>(1)->model;
  TableReader reader = call.options(2);
  const Support anchored = read_anchored(call, reader, model);
  reader.finish();
  const std::vector<elastic::ComponentModes> parts =
      elastic::zero_modes(model, anchored.all_nodes());
  lua_State* L = call.lua();
  begin_list(L, parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    begin_table(L);
    set_field(L, "first_node", parts[i].first_node + 1);
    set_field(L, "node_count", parts[i].node_count);
    set_field(L, "anchored", parts[i].anchored);
    set_field(L, "zero_modes", parts[i].zero_modes);
    set_field(L, "expected", parts[i].expected);
    std::vector<std::uint32_t> nodes = parts[i].mechanism_nodes;
    for (std::uint32_t& node : nodes) ++node;
    set_field(L, "mechanism_nodes", nodes);
    end_list_entry(L, i + 1);
  }
  return 1;
}

int modes_binding(Call& call) {
  const MassSpringModel& model = *call.value<ModelValue>(1)->model;
  elastic::ModeOptions options;
  options.progress = call.progress();
  TableReader reader = call.options(2);
  read_options(call, reader, options);
  const Support anchored = read_anchored(call, reader, model);
  reader.finish();
  const elastic::Modes found = elastic::lowest_modes(
      elastic::elastic_body(model, {.anchored = anchored, .progress = call.progress()}), options);
  if (!anchored.empty() && found.zero_modes_skipped > 0)
    call.session().console().say(
        fmt::format("modes: the anchors leave {} zero modes, which are omitted; s.zero_modes with "
                    "the same anchors lists the nodes that move",
                    found.zero_modes_skipped));
  lua_State* L = call.lua();
  begin_list(L, found.modes.size());
  for (std::size_t i = 0; i < found.modes.size(); ++i) {
    begin_table(L);
    set_field(L, "frequency", found.modes[i].frequency());
    set_field(L, "residual", found.modes[i].residual);
    set_field(L, "shape", found.modes[i].shape);
    end_list_entry(L, i + 1);
  }
  return 1;
}

void push_solution(lua_State* L, const elastic::StaticSolution& solution) {
  begin_table(L);
  set_field(L, "compliance", solution.compliance);
  set_field(L, "residual", solution.residual);
  set_field(L, "displacement", solution.displacement);
}

int static_loads_binding(Call& call) {
  const MassSpringModel& model = *call.value<ModelValue>(1)->model;
  TableReader reader = call.options(2);
  const Support anchored = read_anchored(call, reader, model);
  reader.finish();
  const std::vector<elastic::StaticLoad> loads = elastic::smooth_loads(model);
  const std::vector<elastic::StaticSolution> solutions = elastic::solve_static(
      elastic::elastic_body(model, {.anchored = anchored, .progress = call.progress()}), loads);
  lua_State* L = call.lua();
  begin_list(L, loads.size());
  for (std::size_t i = 0; i < loads.size(); ++i) {
    push_solution(L, solutions[i]);
    set_field(L, "name", loads[i].name);
    set_field(L, "force", loads[i].force);
    end_list_entry(L, i + 1);
  }
  return 1;
}

/// The nodes of anchors that hold them and of those that pull them by springs, at rest.
struct AnchoredNodes {
  AnchoredNodes(const MassSpringModel& model, const std::vector<sim::Anchor>& anchors)
      : held(model, anchors, model.rest),
        on_springs(model, anchors, model.rest, sim::HeldNodes::By::springs) {}
  void move_to(double time) {
    held.move_to(time);
    on_springs.move_to(time);
  }
  sim::HeldNodes held, on_springs;
};

/// What each anchor does to the body, from the forces on its nodes.
void set_anchor_loads(lua_State* L, const std::vector<sim::Anchor>& anchors,
                      const AnchoredNodes& anchored, const std::vector<Vec3>& reaction) {
  std::vector<sim::AnchorLoad> loads(anchors.size());
  for (const sim::HeldNodes* nodes : {&anchored.held, &anchored.on_springs})
    for (std::uint32_t h = 0; h < nodes->count(); ++h) {
      sim::AnchorLoad& load = loads[nodes->anchor(h)];
      const Vec3& force = reaction[nodes->node(h)];
      load.force += force;
      load.torque += (nodes->at()[h] - nodes->pivot(nodes->anchor(h))).cross(force);
    }
  begin_list(L, anchors.size());
  for (std::size_t a = 0; a < anchors.size(); ++a) {
    begin_table(L);
    set_field(L, "name", anchors[a].name);
    set_field(L, "force", loads[a].force);
    set_field(L, "torque", loads[a].torque);
    end_list_entry(L, a + 1);
  }
  end_field(L, "anchor_loads");
}

void push_large(Call& call, const MassSpringModel& model, const std::vector<Vec3>& force,
                const std::vector<sim::Anchor>& anchors) {
  AnchoredNodes anchored(model, anchors);
  const double end = sim::end_of_paths(anchors);
  const elastic::LargeLoad load{.force = force,
                                .anchored = sim::support_of(anchors, model),
                                .hold = [&](double part, std::vector<Vec3>& places) {
                                  anchored.move_to(part * end);
                                  anchored.held.put(places);
                                  anchored.on_springs.put(places);
                                }};
  const elastic::LargeSolution found =
      elastic::deflect_far(model, load, {.progress = call.progress()});
  double work = 0;
  for (std::size_t i = 0; i < force.size(); ++i) work += force[i].dot(found.displacement[i]);
  lua_State* L = call.lua();
  begin_table(L);
  set_field(L, "compliance", work);
  set_field(L, "energy", found.energy);
  set_field(L, "residual", found.residual);
  set_field(L, "load_steps", found.load_steps);
  set_field(L, "iterations", found.iterations);
  set_field(L, "displacement", found.displacement);
  anchored.move_to(end);
  set_anchor_loads(L, anchors, anchored, found.reaction);
}

void push_small(Call& call, const MassSpringModel& model, const std::vector<Vec3>& force,
                const std::vector<sim::Anchor>& anchors) {
  const elastic::ElasticBody body = elastic::elastic_body(
      model, {.anchored = sim::support_of(anchors, model), .progress = call.progress()});
  const elastic::StaticSolution solution =
      elastic::solve_static(body, {{"of deflect", force}}).front();
  push_solution(call.lua(), solution);
  set_field(call.lua(), "energy", solution.compliance / 2);
  std::vector<Vec3> reaction;
  elastic::apply_stiffness(model, solution.displacement, reaction);
  for (std::size_t i = 0; i < reaction.size(); ++i) reaction[i] -= force[i];
  set_anchor_loads(call.lua(), anchors, AnchoredNodes(model, anchors), reaction);
}

int deflect_binding(Call& call) {
  const MassSpringModel& model = *call.value<ModelValue>(1)->model;
  TableReader reader = call.options(2);
  const std::vector<sim::Anchor> anchors = read_anchors(call, reader, model);
  bool large = false;
  reader.read("large", large);
  const bool moves = sim::end_of_paths(anchors) > 0;
  if (moves && !large) reader.refuse("large", "true for anchors that follow a path");
  if (!reader.has("force") && !moves)
    reader.refuse("force", "given: which forces pull at the nodes");
  const std::vector<Vec3> force = read_forces(reader, model);
  reader.finish();
  large ? push_large(call, model, force, anchors) : push_small(call, model, force, anchors);
  return 1;
}

void describe_measurements(Api& api, const Parameter& model) {
  api.add(FunctionEntry{
      .name = "stretch",
      .group = kGroup,
      .summary = "Measures Young's modulus and Poisson's ratio of a bar by a stretch test.",
      .arguments = {model},
      .options = {{.name = "axis",
                   .type = "one of",
                   .fallback = "\"z\"",
                   .help = "axis along which the end planes are pulled apart",
                   .choices = words_of(kAxes)},
                  {.name = "cross_section",
                   .type = "number",
                   .range = Range{1e-18, 1e12},
                   .fallback = "volume / length",
                   .help = "area that the force is divided by [m2]"}},
      .returns = "table: young [Pa], poisson, reaction [N] and strain_energy [J], both at strain 1",
      .errors = "Fewer than two planes of nodes along the axis.",
      .example = "print(s.stretch(base, {axis = \"z\"}).young)",
      .call = stretch_binding});
  api.add(FunctionEntry{
      .name = "zero_modes",
      .group = kGroup,
      .summary = "Counts the zero modes of each connected component.",
      .arguments = {model},
      .options = {anchored_parameter()},
      .returns =
          "list of tables: first_node, node_count, anchored (how many nodes are), zero_modes, "
          "expected (6; 5 for a line, 3 for one node, 0 for an anchored part), "
          "mechanism_nodes (those that move in zero modes beyond the expected)",
      .errors = "A node that the model does not have.",
      .example = "for _, part in ipairs(s.zero_modes(chain[1])) do\n"
                 "  if part.zero_modes > part.expected then print(s.inspect(part)) end\nend",
      .call = zero_modes_binding});
}

std::vector<Parameter> modes_parameters() {
  std::vector<Parameter> parameters = parameters_of<elastic::ModeOptions>();
  parameters.push_back(anchored_parameter());
  return parameters;
}

void describe_modes(Api& api, const Parameter& model) {
  api.add(FunctionEntry{
      .name = "modes",
      .group = kGroup,
      .summary = "The lowest natural frequencies and modes of the model, free or anchored.",
      .arguments = {model},
      .options = modes_parameters(),
      .returns = "list of tables, lowest first: frequency [Hz], residual (bound of the relative "
                 "error of its square), shape (for each node {x, y, z}; sum of mass times square "
                 "= 1; zero where anchored)",
      .errors = "count 0, an accuracy outside 1e-12..0.1, hundreds of mechanisms in a large "
                "component, an anchored node that the model does not have. Zero modes that anchors "
                "leave are reported and omitted.",
      .example = "for _, mode in ipairs(s.modes(base, {count = 5})) do print(mode.frequency) end\n"
                 "local clamped = s.modes(base, {anchored = function(node) return node.x < 0.001 "
                 "end})",
      .call = modes_binding});
}

void describe_statics(Api& api, const Parameter& model) {
  const std::string solution =
      "compliance [J] (forces times displacements), residual (last change by the iteration / "
      "displacement), displacement (for each node {x, y, z} [m]; without rigid motion if nothing "
      "is anchored)";
  api.add(FunctionEntry{
      .name = "static_loads",
      .group = kGroup,
      .summary = "Static displacements under nine smooth loads of 1 N: three stretches, three "
                 "shears, two bends and a twist of the longest axis.",
      .arguments = {model},
      .options = {anchored_parameter()},
      .returns = "list of tables: name, force (for each node {x, y, z} [N]), " + solution,
      .errors = "Hundreds of mechanisms in a large component; anchors that do not resist a load.",
      .example = "for _, load in ipairs(s.static_loads(base)) do print(load.name, "
                 "load.compliance) end",
      .call = static_loads_binding});
  api.add(FunctionEntry{
      .name = "deflect",
      .group = kGroup,
      .summary = "Static displacements under forces on the nodes, of the free or anchored model; "
                 "small ones, or of any size.",
      .arguments = {model},
      .options = {{.name = "force",
                   .type = "table or function",
                   .fallback = "none, if anchors move",
                   .help = "force on each node [N]: a table from node number to {x, y, z}, or a "
                           "function of a Node that returns {x, y, z} or nothing"},
                  {.name = "large",
                   .type = "boolean",
                   .fallback = "false",
                   .help = "find the equilibrium at large displacements and rotations, by load "
                           "steps and Newton's method; anchors may then follow paths, of which "
                           "the last pose counts, and must leave no motion free"},
                  anchored_parameter()},
      .returns = "table: " + solution +
                 ", energy (of the body and of springs of anchors [J]), anchor_loads (for each "
                 "anchor: name, force on the "
                 "body [N] and torque about its pivot [N m]); if large also load_steps and "
                 "iterations, and residual is that of the forces",
      .errors = "No force given; forces along motions that the anchors leave free. Without "
                "anchors, inertia relief balances the net force and torque. If large: anchors that "
                "leave a motion free; a load under which the body collapses.",
      .example = "local bent = s.deflect(base, {\n"
                 "  anchored = function(node) return node.x < 0.001 end,\n"
                 "  force = {[base.node_count] = {0, 0, -1}}})\n"
                 "print(bent.displacement[base.node_count][3])\n"
                 "local turned = s.deflect(base, {large = true, anchored = {\n"
                 "  {nodes = function(node) return node.z < 0.001 end},\n"
                 "  {nodes = function(node) return node.z > 0.099 end,\n"
                 "    path = {{time = 1, turn = {angle = \"30 deg\"}}}}}})\n"
                 "print(turned.anchor_loads[2].torque[3])",
      .call = deflect_binding});
}

}  // namespace

void describe_elastic(Api& api) {
  const Parameter model{.name = "model", .type = "Model", .help = "a model or a level of a chain"};
  describe_measurements(api, model);
  describe_modes(api, model);
  describe_statics(api, model);
}

}  // namespace springlod::scripting
