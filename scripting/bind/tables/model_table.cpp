#include "scripting/bind/tables/model_table.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "scripting/bind/tables/records.hpp"

namespace springlod::scripting {

namespace {

struct TableSpring {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  double length = 0;
  double stiffness = 0;
  std::optional<double> damping;  // none: the damping time of a's material times the stiffness
};

std::uint32_t material_number(const MassSpringModel& model, const std::string& name,
                              const std::string& owner) {
  for (std::uint32_t i = 0; i < model.materials.size(); ++i)
    if (model.materials[i].name == name) return i;
  throw InputError(fmt::format("{}: there is no material '{}' in materials", owner, name));
}

// A table that holds its first fields without names, {x, y, z, mass = ...}: moves them to `names`.
// Pushes the new table.
void name_list_part(lua_State* L, int table, const std::vector<const char*>& names,
                    const std::string& owner) {
  if (!lua_istable(L, table))
    throw InputError(fmt::format("{} must be a table, got {}", owner, describe_type_at(L, table)));
  lua_newtable(L);
  lua_pushnil(L);
  while (lua_next(L, table) != 0) {
    lua_pushvalue(L, -2);
    if (lua_isinteger(L, -1) != 0 && lua_tointeger(L, -1) >= 1 &&
        lua_tointeger(L, -1) <= static_cast<lua_Integer>(names.size())) {
      const char* name = names[static_cast<std::size_t>(lua_tointeger(L, -1)) - 1];
      lua_pop(L, 1);
      lua_pushstring(L, name);
    }
    lua_insert(L, -2);
    lua_rawset(L, -4);
  }
}

void read_node(Call& call, int table, const std::string& owner, MassSpringModel& model) {
  TableReader reader = call.record(table, "Node", owner);
  reader.has("number");
  for (const char* field : {"x", "y", "z", "mass"})
    if (!reader.has(field)) reader.refuse(field, "given");
  Vec3 position;
  double mass = 0;
  reader.read("x", position.x());
  reader.read("y", position.y());
  reader.read("z", position.z());
  reader.read("mass", mass);
  std::string material = model.materials.front().name;
  reader.read("material", material);
  const std::uint32_t number = material_number(model, material, owner);
  double volume = mass / model.materials[number].density;
  reader.read("volume", volume);
  double contact_area = 0;
  reader.read("contact_area", contact_area);
  bool border = false;
  reader.read("border", border);
  reader.finish();
  model.rest.push_back(position);
  model.mass.push_back(mass);
  model.volume.push_back(volume);
  model.contact_area.push_back(contact_area);
  model.border.push_back(border ? 1 : 0);
  model.material.push_back(number);
}

std::uint32_t read_end(TableReader& reader, const char* name, const MassSpringModel& model) {
  std::uint32_t number = 0;
  reader.read(name, number);
  if (number < 1 || number > model.node_count())
    reader.refuse(name, fmt::format("a node number of 1 to {}", model.node_count()));
  return number - 1;
}

TableSpring read_spring(Call& call, int table, const std::string& owner,
                        const MassSpringModel& model) {
  TableReader reader = call.record(table, "Spring", owner);
  reader.has("number");
  TableSpring spring;
  spring.a = read_end(reader, "a", model);
  spring.b = read_end(reader, "b", model);
  if (spring.a > spring.b) std::swap(spring.a, spring.b);
  if (!reader.has("k")) reader.refuse("k", "given: the stiffness in N/m");
  reader.read("k", spring.stiffness);
  reader.read("c", spring.damping);
  spring.length = (model.rest[spring.b] - model.rest[spring.a]).norm();
  reader.read("length", spring.length);
  reader.finish();
  return spring;
}

template <class Read>
void each_entry(Call& call, int list, const char* what, const std::vector<const char*>& names,
                Read read) {
  lua_State* L = call.lua();
  if (!lua_istable(L, list))
    throw InputError(
        fmt::format("model: {} must be a list of tables, got {}", what, describe_type_at(L, list)));
  const auto count = static_cast<lua_Integer>(lua_rawlen(L, list));
  for (lua_Integer i = 1; i <= count; ++i) {
    const std::string owner = fmt::format("model: {}[{}]", what, i);
    lua_rawgeti(L, list, i);
    name_list_part(L, lua_gettop(L), names, owner);
    read(lua_gettop(L), owner);
    lua_pop(L, 2);
  }
}

// Wave speed from eq. 2 of the paper: sqrt(E / rho) without the volume, which cancels out.
double lowest_frequency(const MassSpringModel& model, const std::vector<TableSpring>& springs) {
  const double extent = bounds(model.rest).sizes().maxCoeff();
  if (springs.empty() || !(extent > 0)) return 0;
  double work = 0;
  for (const TableSpring& spring : springs)
    work += spring.stiffness * spring.length * spring.length;
  const double mass = std::accumulate(model.mass.begin(), model.mass.end(), 0.0);
  return lowest_frequency_estimate(std::sqrt(work / (6 * mass)), extent);
}

void add_springs(MassSpringModel& model, std::vector<TableSpring>& springs) {
  std::sort(springs.begin(), springs.end(), [](const TableSpring& p, const TableSpring& q) {
    return std::tie(p.a, p.b) < std::tie(q.a, q.b);
  });
  for (const TableSpring& spring : springs) {
    model.a.push_back(spring.a);
    model.b.push_back(spring.b);
    model.rest_length.push_back(spring.length);
    model.stiffness.push_back(spring.stiffness);
    model.damping.push_back(spring.damping.value_or(
        model.materials[model.material[spring.a]].damping * spring.stiffness));
  }
}

Corner read_corner(Call& call, int table, const std::string& owner, const MassSpringModel& model) {
  TableReader reader = call.record(table, "Corner", owner);
  reader.has("number");
  reader.has("volume");
  std::vector<std::uint32_t> nodes;
  reader.read("nodes", nodes);
  Corner corner;
  if (nodes.size() != corner.node.size())
    reader.refuse("nodes", "a list of four node numbers: the corner's node, then its neighbours");
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (nodes[n] < 1 || nodes[n] > model.node_count())
      reader.refuse("nodes", fmt::format("node numbers of 1 to {}", model.node_count()));
    corner.node[n] = nodes[n] - 1;
  }
  corner.young = model.materials[model.material[corner.node[0]]].young;
  reader.read("young", corner.young);
  reader.finish();
  if (!orient(corner, model.rest))
    reader.refuse("nodes", fmt::format("the nodes of a corner that is not flat: its volume must be "
                                       "at least {} of the product of its three edges",
                                       kFlatCorner));
  return corner;
}

std::vector<MaterialInput> read_material_list(Call& call, TableReader& options) {
  const int list = options.raw("materials");
  if (list == 0) return {{.material = {.name = "default"}}};
  std::vector<MaterialInput> inputs;
  each_entry(call, list, "materials", {}, [&](int table, const std::string& owner) {
    inputs.push_back(
        read_material(call, table, owner, fmt::format("material_{}", inputs.size() + 1)));
  });
  if (inputs.empty()) options.refuse("materials", "a list of at least one Material");
  return inputs;
}

std::vector<Material> all_resolved(const std::vector<MaterialInput>& inputs, double omega) {
  std::vector<Material> materials;
  for (const MaterialInput& input : inputs) materials.push_back(resolved(input, omega));
  return materials;
}

}  // namespace

MassSpringModel model_from_tables(Call& call, TableReader& options) {
  MassSpringModel model;
  const std::vector<MaterialInput> inputs = read_material_list(call, options);
  model.materials = all_resolved(inputs, 0);  // nodes need names and densities
  const int nodes = options.raw("nodes");
  if (nodes == 0) options.refuse("nodes", "given: a list of {x, y, z, mass = ...}");
  each_entry(call, nodes, "nodes", {"x", "y", "z"},
             [&](int table, const std::string& owner) { read_node(call, table, owner, model); });
  std::vector<TableSpring> springs;
  if (const int list = options.raw("springs"))
    each_entry(call, list, "springs", {"a", "b"}, [&](int table, const std::string& owner) {
      springs.push_back(read_spring(call, table, owner, model));
    });
  model.materials = all_resolved(inputs, lowest_frequency(model, springs));
  add_springs(model, springs);
  if (const int list = options.raw("corners"))
    each_entry(call, list, "corners", {}, [&](int table, const std::string& owner) {
      model.corners.push_back(read_corner(call, table, owner, model));
    });
  std::sort(model.corners.begin(), model.corners.end(),
            [](const Corner& l, const Corner& r) { return l.node < r.node; });
  validate(model);
  return model;
}

void push_node(lua_State* L, const MassSpringModel& model, std::uint32_t number) {
  begin_table(L);
  set_field(L, "number", number + 1);
  set_field(L, "x", model.rest[number].x());
  set_field(L, "y", model.rest[number].y());
  set_field(L, "z", model.rest[number].z());
  set_field(L, "mass", model.mass[number]);
  set_field(L, "volume", model.volume[number]);
  set_field(L, "contact_area", model.contact_area[number]);
  set_field(L, "border", model.border[number] != 0);
  set_field(L, "material", model.materials[model.material[number]].name);
}

void push_spring(lua_State* L, const MassSpringModel& model, std::uint32_t number) {
  begin_table(L);
  set_field(L, "number", number + 1);
  set_field(L, "a", model.a[number] + 1);
  set_field(L, "b", model.b[number] + 1);
  set_field(L, "k", model.stiffness[number]);
  set_field(L, "c", model.damping[number]);
  set_field(L, "length", model.rest_length[number]);
}

void push_corner(lua_State* L, const MassSpringModel& model, std::uint32_t number) {
  const Corner& corner = model.corners[number];
  std::vector<std::uint32_t> nodes(corner.node.begin(), corner.node.end());
  for (std::uint32_t& node : nodes) ++node;
  begin_table(L);
  set_field(L, "number", number + 1);
  set_field(L, "nodes", nodes);
  set_field(L, "young", corner.young);
  set_field(L, "volume", corner_volume(corner, model.rest));
}

void describe_model_tables(Api& api) {
  const auto coordinate = [](const char* name) {
    return Parameter{.name = name,
                     .type = "quantity",
                     .dimension = Dimension::length,
                     .help = "rest position; x, y, z may come first without names"};
  };
  api.add(RecordEntry{
      .name = "Node",
      .summary =
          "A mass point: input of s.model and result of model:node(i), which adds the number.",
      .fields = {{.name = "number",
                  .type = "integer",
                  .fallback = "position in the list",
                  .help = "number of the node, from 1; ignored by s.model"},
                 coordinate("x"),
                 coordinate("y"),
                 coordinate("z"),
                 {.name = "mass", .type = "quantity", .dimension = Dimension::mass, .help = "mass"},
                 {.name = "volume",
                  .type = "number",
                  .fallback = "mass / density of its material",
                  .help = "volume that the node represents [m3]"},
                 {.name = "contact_area",
                  .type = "number",
                  .fallback = "0",
                  .help = "area of the surface that the node represents [m2]; 0: no contact"},
                 {.name = "border",
                  .type = "boolean",
                  .fallback = "false",
                  .help = "whether the node lies on the surface"},
                 {.name = "material",
                  .type = "string",
                  .fallback = "the first material",
                  .help = "name of its material"}},
      .example = "{0, 0, 0, mass = \"5 g\"}"});
  api.add(RecordEntry{
      .name = "Spring",
      .summary = "A spring: input of s.model and result of model:spring(i), which adds the number.",
      .fields = {{.name = "number",
                  .type = "integer",
                  .fallback = "position in the list",
                  .help = "number of the spring, from 1; ignored by s.model"},
                 {.name = "a",
                  .type = "integer",
                  .help = "number of one node; may come first without a name"},
                 {.name = "b",
                  .type = "integer",
                  .help = "number of the other node; may come second without a name"},
                 {.name = "k", .type = "number", .help = "stiffness [N/m]"},
                 {.name = "c",
                  .type = "number",
                  .fallback = "damping time of a's material times k",
                  .help = "damping [N s/m]"},
                 {.name = "length",
                  .type = "quantity",
                  .dimension = Dimension::length,
                  .fallback = "distance of its nodes",
                  .help = "rest length"}},
      .example = "{1, 2, k = 100}"});
  api.add(RecordEntry{
      .name = "Corner",
      .summary = "A corner of a cell, whose volume keeps its sign: input of s.model and result of "
                 "model:corner(i), which adds number and volume.",
      .fields = {{.name = "number",
                  .type = "integer",
                  .fallback = "position in the list",
                  .help = "number of the corner, from 1; ignored by s.model"},
                 {.name = "nodes",
                  .type = "list of integers",
                  .help = "four node numbers: the corner's node, then its three neighbours, which "
                          "springs join to it. s.model puts the neighbours in order"},
                 {.name = "young",
                  .type = "quantity",
                  .dimension = Dimension::pressure,
                  .fallback = "that of the first node's material",
                  .help = "Young's modulus"},
                 {.name = "volume",
                  .type = "number",
                  .fallback = "from the nodes",
                  .help =
                      "volume of the parallelepiped of its three edges at rest [m3]; ignored by "
                      "s.model"}},
      .example = "{nodes = {1, 2, 3, 4}}"});
}

}  // namespace springlod::scripting
