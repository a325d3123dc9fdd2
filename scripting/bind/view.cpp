// What a page shows in 3D.

#include "report/view/view.hpp"

#include <cmath>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/base64.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/progress.hpp"
#include "report/view/packed.hpp"
#include "scripting/bind/tables/comparisons.hpp"
#include "scripting/bind/tables/options.hpp"
#include "scripting/bind/tables/value_list.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "scripting/engine/result_table.hpp"

namespace springlod::scripting {

namespace {

constexpr const char* kGroup = "Pictures and reports";

void set_packed(lua_State* L, const char* name, const report::PackedWhole& packed) {
  begin_table(L);
  set_field(L, "type", packed.type);
  set_field(L, "data", packed.data);
  end_field(L, name);
}

void set_rows(lua_State* L, const char* name, const Binding& rows) {
  const report::PackedRows packed = report::pack(rows);
  begin_table(L);
  set_packed(L, "count", packed.count);
  set_packed(L, "node", packed.node);
  set_field(L, "scale", packed.scale);
  set_field(L, "weight", packed.weight);
  end_field(L, name);
}

template <class Tuples>
report::PackedWhole pack_tuples(const Tuples& tuples) {
  std::vector<std::uint32_t> flat;
  for (const auto& tuple : tuples) flat.insert(flat.end(), tuple.begin(), tuple.end());
  return report::pack(flat);
}

void fill_body(lua_State* L, const report::ViewBody& body) {
  set_field(L, "label", body.label);
  set_field(L, "chain", body.chain + 1);
  set_field(L, "level", body.level);
  set_field(L, "nodes", body.colour.size());
  set_field(L, "springs", body.springs);
  set_packed(L, "ends", pack_tuples(body.ends));
  set_packed(L, "colour", report::pack(body.colour));
  if (body.to_base.point_count() > 0) set_rows(L, "to_base", body.to_base);
  const report::PackedPositions positions = report::pack(body.frames);
  set_field(L, "low", positions.low);
  set_field(L, "size", positions.size);
  set_field(L, "positions", positions.data);
}

void fill_obstacle(lua_State* L, const sim::Obstacle& obstacle) {
  set_field(L, "name", obstacle.name);
  if (const auto* plane = std::get_if<sim::Plane>(&obstacle.shape)) {
    set_field(L, "normal", plane->normal);
    set_field(L, "offset", plane->offset);
  } else if (const auto* box = std::get_if<sim::SolidBox>(&obstacle.shape)) {
    set_field(L, "center", box->center);
    set_field(L, "half_size", box->half_size);
    set_field(L, "rotation", box->rotation);
  }
}

std::string hex(const Colour& colour) {
  constexpr float kMost = 255;
  const auto byte = [](float part) { return static_cast<int>(std::lround(kMost * part)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(colour.r), byte(colour.g), byte(colour.b));
}

void push_view(lua_State* L, const report::View& view) {
  std::vector<std::string> palette;
  for (const Colour& colour : view.palette) palette.push_back(hex(colour));
  begin_table(L);
  set_field(L, "times", view.times);
  set_field(L, "palette", palette);
  push_tables(L, view.bodies, [&](const report::ViewBody& body) { fill_body(L, body); });
  end_field(L, "bodies");
  push_tables(L, view.obstacles, [&](const sim::Obstacle& each) { fill_obstacle(L, each); });
  end_field(L, "obstacles");
  set_field(L, "left_out", view.left_out);
  if (view.triangles.empty()) return;
  begin_table(L);
  set_packed(L, "triangles", pack_tuples(view.triangles));
  set_packed(L, "colour", report::pack(view.vertex_colour));
  set_rows(L, "rows", view.surface);
  end_field(L, "surface");
}

int view_binding(Call& call) {
  const Task task(call.progress(), "making the 3D view", 0);
  report::ViewOptions options;
  TableReader reader = call.options(2);
  read_options(call, reader, options);
  reader.finish();
  if (const auto chain = call.try_value<ChainValue>(1)) {
    push_view(call.lua(), report::view_of(*chain, options));
    return 1;
  }
  const auto comparisons =
      values_at<ComparisonValue>(call, 1, "a LodChain, a Comparison, or a list of Comparisons");
  push_view(call.lua(), report::view_of(compared_chains(comparisons), options));
  return 1;
}

int base64_binding(Call& call) {
  return call.give(base64(read_file(call.readable(1))));
}

}  // namespace

void describe_view(Api& api) {
  api.add(FunctionEntry{
      .name = "view",
      .group = kGroup,
      .summary =
          "What a page needs to draw levels in 3D and to play their motion, as the pages of demo "
          "and compare do. Positions have 16 bits along the longest side of their box.",
      .arguments = {{.name = "subject",
                     .type = "Comparison, list of Comparison or LodChain",
                     .help =
                         "levels at rest, or the runs of the first start; the chains of several "
                         "comparisons must have one base"}},
      .options = parameters_of<report::ViewOptions>(),
      .returns = "table for s.json: times [s], palette (colours), bodies (base and levels: label, "
                 "nodes, springs, packed arrays), surface, obstacles, and left_out (sentences: "
                 "what is not as asked); docs/pictures.md describes the arrays",
      .errors = "A comparison without frames; chains with different bases; bytes too small for any "
                "level.",
      .example = "s.save_text(\"out/view.json\", s.json(s.view(chain)))",
      .call = view_binding});
  api.add(FunctionEntry{.name = "base64",
                        .group = kGroup,
                        .summary = "The content of a file as base64, to embed it in a page: "
                                   "\"data:video/mp4;base64,\" .. s.base64(path).",
                        .arguments = {{.name = "path", .type = "string", .help = "file to read"}},
                        .returns = "string",
                        .errors = "The file cannot be read.",
                        .example = "print(#s.base64(\"out/dumbbell.glb\"))",
                        .call = base64_binding});
}

}  // namespace springlod::scripting
