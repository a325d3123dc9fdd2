// Mass-spring models: read, built from tables, estimated.

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/message.hpp"
#include "base/units.hpp"
#include "elastic/moduli.hpp"
#include "elastic/stable_step.hpp"
#include "scripting/bind/tables/certificate_table.hpp"
#include "scripting/bind/tables/model_table.hpp"
#include "scripting/bind/tables/records.hpp"
#include "scripting/bind/tables/start_table.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"

namespace springlod::scripting {

namespace {

constexpr const char* kGroup = "Models";

int model_binding(Call& call) {
  TableReader options = call.options(1);
  auto value = std::make_shared<ModelValue>();
  value->model = std::make_shared<const MassSpringModel>(model_from_tables(call, options));
  options.finish();
  value->made_by = "tables";
  value->provenance.set("springlod", version());
  value->provenance.set("model", "tables");
  return call.give(std::shared_ptr<const ModelValue>(value));
}

std::uint32_t element(Call& call, std::uint32_t count) {
  return static_cast<std::uint32_t>(call.integer(1, 1, count) - 1);
}

int node_method(Call& call) {
  const auto self = call.self<ModelValue>();
  push_node(call.lua(), *self->model, element(call, self->model->node_count()));
  return 1;
}

int spring_method(Call& call) {
  const auto self = call.self<ModelValue>();
  push_spring(call.lua(), *self->model, element(call, self->model->spring_count()));
  return 1;
}

int corner_method(Call& call) {
  const auto self = call.self<ModelValue>();
  push_corner(call.lua(), *self->model, element(call, self->model->corner_count()));
  return 1;
}

int nodes_method(Call& call) {
  const auto self = call.self<ModelValue>();
  begin_list(call.lua(), self->model->node_count());
  for (std::uint32_t i = 0; i < self->model->node_count(); ++i) {
    push_node(call.lua(), *self->model, i);
    end_list_entry(call.lua(), i + 1);
  }
  return 1;
}

int springs_method(Call& call) {
  const auto self = call.self<ModelValue>();
  begin_list(call.lua(), self->model->spring_count());
  for (std::uint32_t i = 0; i < self->model->spring_count(); ++i) {
    push_spring(call.lua(), *self->model, i);
    end_list_entry(call.lua(), i + 1);
  }
  return 1;
}

int corners_method(Call& call) {
  const auto self = call.self<ModelValue>();
  begin_list(call.lua(), self->model->corner_count());
  for (std::uint32_t i = 0; i < self->model->corner_count(); ++i) {
    push_corner(call.lua(), *self->model, i);
    end_list_entry(call.lua(), i + 1);
  }
  return 1;
}

int inverted_corners_method(Call& call) {
  const auto self = call.self<ModelValue>();
  const State state = state_at(call, call.index(1), "model:inverted_corners: state", *self->model);
  std::vector<std::uint32_t> numbers = inverted_corners(self->model->corners, state.x);
  for (std::uint32_t& number : numbers) ++number;
  return call.give(numbers);
}

void push_estimate(lua_State* L, const elastic::Eq2Estimate& e) {
  begin_table(L);
  set_field(L, "nodes", e.nodes);
  set_field(L, "mass", e.mass);
  set_field(L, "volume", e.volume);
  set_field(L, "density", e.density);
  set_field(L, "young", e.young);
  set_field(L, "shear", e.shear);
  set_field(L, "bulk", e.bulk);
}

int estimate_binding(Call& call) {
  const auto value = call.value<ModelValue>(1);
  const elastic::ModelEstimate result = elastic::estimate(*value->model);
  lua_State* L = call.lua();
  push_estimate(L, result.whole);
  begin_list(L, result.materials.size());
  for (std::size_t m = 0; m < result.materials.size(); ++m) {
    push_estimate(L, result.materials[m]);
    set_field(L, "name", value->model->materials[m].name);
    end_list_entry(L, m + 1);
  }
  end_field(L, "materials");
  set_field(L, "node_young", result.young);
  set_field(L, "node_density", result.density);
  return 1;
}

int stable_step_binding(Call& call) {
  return call.give(elastic::stable_step(*call.value<ModelValue>(1)->model));
}

void push_bounds(lua_State* L, const ModelValue& value) {
  const Box3 box = bounds(value.model->rest);
  const Vec3 size = box.sizes();
  begin_table(L);
  set_field(L, "low", Vec3(box.min()));
  set_field(L, "high", Vec3(box.max()));
  set_field(L, "diagonal",
            std::sqrt(size.x() * size.x() + size.y() * size.y() + size.z() * size.z()));
}

/// ", damping time 0.2 ms": of the springs, c / k; empty without springs.
std::string damping_text(const MassSpringModel& model) {
  if (model.spring_count() == 0) return "";
  double shortest = std::numeric_limits<double>::infinity();
  double longest = 0;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    shortest = std::min(shortest, model.damping[s] / model.stiffness[s]);
    longest = std::max(longest, model.damping[s] / model.stiffness[s]);
  }
  const std::string low = format_quantity(shortest, Dimension::time);
  const std::string high = format_quantity(longest, Dimension::time);
  return low == high ? fmt::format(", damping time {}", high)
                     : fmt::format(", damping times {} to {}", low, high);
}

std::string model_text(const ModelValue& value) {
  const MassSpringModel& model = *value.model;
  const MassProperties properties = mass_properties(model);
  std::string text = "Model: ";
  if (value.chain) text = fmt::format("Model, level {}: ", value.level);
  text += fmt::format("{} ({} border), {}", counted(model.node_count(), "node"),
                      border_count(model), counted(model.spring_count(), "spring"));
  if (model.corner_count() > 0) text += ", " + counted(model.corner_count(), "corner");
  return text + ", " + format_quantity(properties.mass, Dimension::mass) + damping_text(model);
}

FunctionEntry element_method(const char* name, const char* what, const char* record,
                             int (*binding)(Call&)) {
  return {.name = name,
          .summary = fmt::format("One {}, as a table.", what),
          .arguments = {{.name = "number",
                         .type = "integer",
                         .help = fmt::format("number of the {}, from 1", what)}},
          .returns = fmt::format("{}: with its number", record),
          .call = binding};
}

FunctionEntry list_method(const char* name, const char* what, const char* record,
                          int (*binding)(Call&)) {
  return {.name = name,
          .summary = fmt::format("All {}, as tables.", what),
          .returns = fmt::format("list of {}", record),
          .call = binding};
}

void describe_model_type(Api& api) {
  TypeBuilder<ModelValue> type(
      "A mass-spring model: nodes and springs at one resolution; a level of a chain is one too.",
      model_text);
  type.field("node_count", "integer", "number of nodes",
             [](const ModelValue& value) { return value.model->node_count(); });
  type.field("spring_count", "integer", "number of springs, each counted once",
             [](const ModelValue& value) { return value.model->spring_count(); });
  type.field("end_count", "integer", "number of spring ends: S of the paper",
             [](const ModelValue& value) { return value.model->end_count(); });
  type.field("corner_count", "integer", "number of corners; 0 for a model built without volumes",
             [](const ModelValue& value) { return value.model->corner_count(); });
  type.field("contact_point_count", "integer",
             "points of the true surface of a lattice of cut cells, at which it touches obstacles; "
             "0: it does at its nodes",
             [](const ModelValue& value) { return value.model->surface.count(); });
  type.field("border_count", "integer", "number of border nodes",
             [](const ModelValue& value) { return border_count(*value.model); });
  type.field("part_count", "integer", "number of connected components",
             [](const ModelValue& value) { return connected_components(*value.model).count; });
  type.field("mass", "number", "total mass [kg]",
             [](const ModelValue& value) { return mass_properties(*value.model).mass; });
  type.field("volume", "number", "total volume [m3]",
             [](const ModelValue& value) { return mass_properties(*value.model).volume; });
  type.field("center", "{x, y, z}", "centre of mass [m]",
             [](const ModelValue& value) { return mass_properties(*value.model).center; });
  type.field("inertia", "3 x 3 table", "inertia tensor about the centre of mass [kg m2]",
             [](const ModelValue& value) { return mass_properties(*value.model).inertia; });
  type.table_field("bounds", "table",
                   "box around the nodes: low and high, each {x, y, z}, and its diagonal [m]",
                   push_bounds);
  type.field("young", "number", "Young's modulus by eq. 2 of the paper, an upper bound [Pa]",
             [](const ModelValue& value) { return estimated_young(*value.model); });
  type.table_field(
      "materials", "list of Material", "materials of the nodes",
      [](lua_State* L, const ModelValue& value) { push_materials(L, value.model->materials); });
  type.field("level", "integer", "level in its chain; 0 for a model without a chain",
             [](const ModelValue& value) { return value.level; });
  type.field("made_by", "string", "method by which it was made",
             [](const ModelValue& value) { return value.made_by; });
  type.table_field(
      "provenance", "table of strings", "origin: version, script, parameters, seed and hashes",
      [](lua_State* L, const ModelValue& value) { push_provenance(L, value.provenance); });
  type.method(element_method("node", "node", "Node", node_method));
  type.method(element_method("spring", "spring", "Spring", spring_method));
  type.method(element_method("corner", "corner", "Corner", corner_method));
  type.method(list_method("nodes", "nodes", "Node", nodes_method));
  type.method(list_method("springs", "springs", "Spring", springs_method));
  type.method(list_method("corners", "corners", "Corner", corners_method));
  type.method(
      {.name = "inverted_corners",
       .summary = "The corners whose volume is 0 or negative in a state: there, the body is turned "
                  "inside out.",
       .arguments = {{.name = "state",
                      .type = "State",
                      .help = "positions of all nodes, such as trajectory.final or a frame"}},
       .returns = "list of integers: the numbers of the corners, ascending",
       .errors = "A state with another number of nodes.",
       .example = "print(#chain[1]:inverted_corners(trajectory.final))",
       .call = inverted_corners_method});
  api.add(type.build());
}

void describe_estimates(Api& api) {
  const Parameter model{.name = "model", .type = "Model", .help = "a model or a level of a chain"};
  api.add(FunctionEntry{
      .name = "estimate",
      .group = kGroup,
      .summary =
          "Moduli and densities of a model, its materials and its nodes by eq. 2 of the paper.",
      .arguments = {model},
      .returns = "table: nodes, mass [kg], volume [m3], density [kg/m3], young, shear, bulk [Pa]; "
                 "materials, a list of the same with name; node_young and node_density, lists",
      .errors = "None for a valid model. The moduli are upper bounds; s.stretch measures the "
                "actual ones.",
      .example = "print(s.estimate(base).materials[1].young)",
      .call = estimate_binding});
  api.add(FunctionEntry{.name = "stable_step",
                        .group = kGroup,
                        .summary = "Largest stable time step of the model without contact.",
                        .arguments = {model},
                        .returns = "number: step [s]",
                        .errors = "None for a valid model.",
                        .example = "print(s.stable_step(chain[0]))",
                        .call = stable_step_binding});
}

}  // namespace

void describe_model(Api& api) {
  describe_materials(api);
  describe_model_tables(api);
  describe_model_type(api);
  api.add(
      FunctionEntry{.name = "model",
                    .group = kGroup,
                    .summary = "Builds a model from plain tables of nodes, springs and corners.",
                    .options = {{.name = "nodes", .type = "list of Node", .help = "mass points"},
                                {.name = "springs",
                                 .type = "list of Spring",
                                 .fallback = "none",
                                 .help = "springs between them, in any order"},
                                {.name = "corners",
                                 .type = "list of Corner",
                                 .fallback = "none",
                                 .help = "corners of cells, in any order"},
                                {.name = "materials",
                                 .type = "list of Material",
                                 .fallback = "one, named default",
                                 .help = "materials that the nodes refer to by name"}},
                    .returns = "Model",
                    .errors = "A node, spring or corner that is not valid; the message names it.",
                    .example = "local chain = s.model{\n"
                               "  nodes = {{0, 0, 0, mass = 1}, {1, 0, 0, mass = 1}},\n"
                               "  springs = {{1, 2, k = 100}}}",
                    .call = model_binding});
  describe_estimates(api);
  describe_certificate(api);
  describe_assets(api);
}

}  // namespace springlod::scripting
