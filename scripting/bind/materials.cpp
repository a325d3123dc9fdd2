// Materials and their presets.
#include <fmt/format.h>

#include "model/material_input.hpp"
#include "model/material_preset.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/value.hpp"

namespace springlod::scripting {

namespace {

void push_presets(lua_State* L) {
  const auto rows = choices(MaterialPreset{}).rows;
  begin_list(L, rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    begin_table(L);
    set_field(L, "name", std::string(rows[i].name));
    set_field(L, "help", std::string(rows[i].help));
    set_field(L, "young", rows[i].young);
    set_field(L, "poisson", rows[i].poisson);
    set_field(L, "density", rows[i].density);
    set_field(L, "source", std::string(rows[i].source));
    end_list_entry(L, i + 1);
  }
}

}  // namespace

void describe_materials(Api& api) {
  api.add(ConstantEntry{{.name = "material_presets",
                         .type = "list of tables",
                         .help = "materials with published elastic constants: name, help, young "
                                 "[Pa], poisson, density [kg/m3] and source (of young; of a "
                                 "range, its geometric mean is taken)"},
                        push_presets});
  const MaterialInput input;
  const Material& usual = input.material;
  api.add(RecordEntry{
      .name = "Material",
      .summary = "An elastic material. Springs alone have Poisson's ratio 1/4; with any other one, "
                 "the model gets dilatation terms, which take shorter steps.",
      .fields =
          {{.name = "name", .type = "string", .fallback = "its key", .help = "name in reports"},
           {.name = "preset",
            .type = "one of",
            .fallback = "none",
            .help = "material with published constants, from which young, poisson and density are "
                    "taken unless they are given; s.material_presets has them with their sources",
            .choices = words_of<MaterialPreset>()},
           {.name = "young",
            .type = "quantity",
            .dimension = Dimension::pressure,
            .range = Range{1e-3, 1e15},
            .fallback = fmt::format("{}", usual.young),
            .help = "Young's modulus"},
           {.name = "poisson",
            .type = "number",
            .range = Range{-0.2, 0.495},
            .fallback = fmt::format("{}", usual.poisson),
            .help =
                "Poisson's ratio: how much a stretched bar thins; rubber and flesh 0.45 to 0.5, "
                "cork 0"},
           {.name = "density",
            .type = "quantity",
            .dimension = Dimension::density,
            .range = Range{1e-6, 1e9},
            .fallback = fmt::format("{}", usual.density),
            .help = "density"},
           {.name = "damping",
            .type = "quantity",
            .dimension = Dimension::time,
            .range = Range{0, 1e6},
            .fallback = "from damping_ratio",
            .help = "damping time c/k of its springs"},
           {.name = "damping_ratio",
            .type = "number",
            .range = Range{0, 1},
            .fallback = fmt::format("{}", *input.damping_ratio),
            .help = "damping ratio of the body's slowest vibration, from which its damping time is "
                    "computed when the body is built; 0 or more, below 1; instead of damping"},
           {.name = "colour",
            .type = "\"#rrggbb\" or {r, g, b}",
            .fallback = "grey",
            .help = "colour in pictures; r, g, b of 0..1"}},
      .example = "rubber = {young = \"0.2 MPa\", density = 1000, damping = 0.004, colour = "
                 "\"#40a060\"}"});
}

}  // namespace springlod::scripting
