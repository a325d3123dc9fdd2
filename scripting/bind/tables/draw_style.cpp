#include "scripting/bind/tables/draw_style.hpp"

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"

namespace springlod::scripting {

namespace {

// {low, high}
std::pair<double, double> read_range(TableReader& reader, const char* name) {
  lua_State* L = reader.lua();
  const int table = reader.raw(name);
  if (!lua_istable(L, table) || lua_rawlen(L, table) != 2)
    reader.refuse(name, "{low, high}, such as {0, 1e6}");
  std::pair<double, double> range;
  const std::string what = reader.owner() + ": " + name;
  lua_rawgeti(L, table, 1);
  range.first = quantity_at(L, -1, Dimension::number, what + "[1]");
  lua_rawgeti(L, table, 2);
  range.second = quantity_at(L, -1, Dimension::number, what + "[2]");
  lua_pop(L, 3);
  if (!(range.first < range.second))
    reader.refuse(name, fmt::format("{{low, high}} with low < high, got {{{}, {}}}", range.first,
                                    range.second));
  return range;
}

// {nx, ny, nz, offset}
render::DrawnPlane read_cut(TableReader& reader, const char* name) {
  lua_State* L = reader.lua();
  const int table = reader.raw(name);
  if (!lua_istable(L, table) || lua_rawlen(L, table) != 4)
    reader.refuse(name, "{nx, ny, nz, offset}, such as {0, 1, 0, 0} for all with y >= 0");
  double numbers[4];
  for (int i = 0; i < 4; ++i) {
    lua_rawgeti(L, table, i + 1);
    numbers[i] = quantity_at(L, -1, Dimension::number,
                             fmt::format("{}: {}[{}]", reader.owner(), name, i + 1));
    lua_pop(L, 1);
  }
  lua_pop(L, 1);
  render::DrawnPlane cut{Vec3(numbers[0], numbers[1], numbers[2]), numbers[3]};
  if (!(cut.normal.norm() > 0)) reader.refuse(name, "a plane with a normal other than zero");
  return cut;
}

}  // namespace

void show_node_values(TableReader& reader, render::DrawStyle& style) {
  if (!reader.has("nodes")) style.nodes = true;
  if (!reader.has("surface")) style.surface = false;
}

void read_style(TableReader& reader, render::DrawStyle& style) {
  reader.read("node_colour", style.node_colour);
  if (reader.has("node_colour") && style.node_colour != render::NodeColour::material)
    show_node_values(reader, style);
  reader.read("value_label", style.values.label);
  if (reader.has("value_range")) style.values.range = read_range(reader, "value_range");
  reader.read("value_scale", style.values.scaling);
  reader.read("node_size", style.node_size);
  if (reader.has("cut")) style.cut = read_cut(reader, "cut");
  reader.read("surface", style.surface);
  reader.read("nodes", style.nodes);
  reader.read("springs", style.springs);
  reader.read("spring_colour", style.spring_colour);
  reader.read("strain_range", style.strain_range);
  reader.read("node_radius", style.node_radius);
  reader.read("surface_opacity", style.surface_opacity);
  reader.read("bold_inner_nodes", style.bold_inner_nodes);
}

std::vector<Parameter> style_parameters(const render::DrawStyle& usual) {
  const auto truth = [](bool value) { return std::string(value ? "true" : "false"); };
  return {
      {.name = "surface",
       .type = "boolean",
       .fallback = truth(usual.surface),
       .help = "draw the shaded surface, if there is one"},
      {.name = "nodes",
       .type = "boolean",
       .fallback = truth(usual.nodes),
       .help = "draw nodes as balls"},
      {.name = "springs",
       .type = "boolean",
       .fallback = truth(usual.springs),
       .help = "draw springs"},
      {.name = "node_colour",
       .type = "one of",
       .fallback = "\"material\"",
       .help =
           "quantity shown by the colour of a node. All but material come with a colour bar, draw "
           "the nodes and leave the surface out, "
           "unless nodes and surface are given",
       .choices = words_of<render::NodeColour>()},
      {.name = "value_label",
       .type = "string",
       .fallback = "the name of node_colour",
       .help = "written over the colour bar; with node_values it names their unit too"},
      {.name = "value_range",
       .type = "{low, high}",
       .fallback = "least and largest of all panels",
       .help = "values at the ends of the colour bar, in SI units"},
      {.name = "value_scale",
       .type = "one of",
       .fallback = "\"automatic\"",
       .help = "of the colour bar",
       .choices = words_of<render::ValueScaling>()},
      {.name = "node_size",
       .type = "one of",
       .fallback = "\"even\"",
       .help = "of the balls",
       .choices = words_of<render::NodeSize>()},
      {.name = "node_radius",
       .type = "quantity",
       .dimension = Dimension::length,
       .fallback = "a part of the mean spring length",
       .help = "radius of the balls; with node_size = \"mass\" that of a node of mean mass"},
      {.name = "spring_colour",
       .type = "one of",
       .fallback = "\"material\"",
       .help = "quantity shown by the colour of a spring",
       .choices = words_of<render::SpringColour>()},
      {.name = "strain_range",
       .type = "number",
       .fallback = fmt::format("{}", usual.strain_range),
       .help = "strain drawn in full red (stretched) or blue (compressed)"},
      {.name = "surface_opacity",
       .type = "number",
       .fallback = fmt::format("{}", usual.surface_opacity),
       .help = "below 1 shows the springs inside"},
      {.name = "cut",
       .type = "{nx, ny, nz, offset}",
       .fallback = "none",
       .help = "leaves out the nodes with n . x < offset at rest, and their springs, so that "
               "one sees inside; {0, 1, 0, 0} keeps y >= 0. The surface stays whole"},
      {.name = "bold_inner_nodes",
       .type = "boolean",
       .fallback = truth(usual.bold_inner_nodes),
       .help = "nodes off the border in bold red"}};
}

}  // namespace springlod::scripting
