#include "scripting/bind/tables/draw_style.hpp"

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/bind/tables/options.hpp"
#include "scripting/engine/quantity.hpp"

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
  range.first = usual_quantity_at(L, -1, Dimension::number, what + "[1]");
  lua_rawgeti(L, table, 2);
  range.second = usual_quantity_at(L, -1, Dimension::number, what + "[2]");
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
    numbers[i] = usual_quantity_at(L, -1, Dimension::number,
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

void read_style(const Call& call, TableReader& reader, render::DrawStyle& style) {
  read_options(call, reader, style);
  if (reader.has("node_colour") && style.node_colour != render::NodeColour::material)
    show_node_values(reader, style);
  if (reader.has("value_range")) style.values.range = read_range(reader, "value_range");
  if (reader.has("cut")) style.cut = read_cut(reader, "cut");
}

std::vector<Parameter> style_parameters(const render::DrawStyle& usual) {
  std::vector<Parameter> parameters = parameters_of(usual);
  parameters.push_back({.name = "value_range",
                        .type = "{low, high}",
                        .fallback = "smallest and largest value of all panels",
                        .help = "values at the ends of the colour bar, in SI units"});
  parameters.push_back(
      {.name = "cut",
       .type = "{nx, ny, nz, offset}",
       .fallback = "none",
       .help =
           "cuts the body open: hides what has n . x < offset at rest, of the surface, the nodes "
           "and the springs; {0, 1, 0, 0} keeps y >= 0. The cut face of a closed surface is "
           "hatched, unless nodes or springs are drawn"});
  return parameters;
}

}  // namespace springlod::scripting
