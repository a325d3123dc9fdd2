// Assets: chains saved, loaded and described.

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <lua.hpp>

#include "elastic/stable_step.hpp"
#include "lod/transfer.hpp"
#include "model/asset/asset.hpp"
#include "scripting/bind/tables/certificate_table.hpp"
#include "scripting/bind/tables/records.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "sim/integrators/step_bound.hpp"

namespace springlod::scripting {

namespace {

constexpr const char* kGroup = "Assets";

std::vector<SlimLevel> slim_levels(const LodChain& chain) {
  std::vector<SlimLevel> levels;
  for (std::uint32_t n = 0; n < chain.levels.size(); ++n)
    levels.push_back({.of_level = n > 0 ? lod::base_from_level(chain, n) : Binding(),
                      .stable_step = elastic::stable_step(chain.levels[n].model)});
  return levels;
}

int save_binding(Call& call) {
  const auto chain = call.value<ChainValue>(2);
  TableReader options = call.options(3);
  std::optional<std::string> command;
  bool slim = false;
  options.read("command", command);
  options.read("slim", slim);
  options.finish();
  const std::filesystem::path path = call.writable(1);
  std::optional<LodAsset> told;
  if (command) {
    told = *chain;
    told->provenance.set("command", *command);
  }
  const LodAsset* asset = told ? &*told : chain.get();
  if (slim)
    save_slim_asset(*asset, slim_levels(asset->chain), path);
  else
    save_asset(*asset, path);
  return 0;
}

int load_binding(Call& call) {
  return call.give(std::make_shared<const ChainValue>(load_asset(call.readable(1))));
}

/// `base_time`: as for push_certificate; needed only for a level with a certificate.
void push_level_info(lua_State* L, const Level& level, std::size_t number,
                     const std::optional<sim::StepTime>& base_time) {
  const MassSpringModel& model = level.model;
  const MassProperties properties = mass_properties(model);
  begin_table(L);
  set_field(L, "level", number);
  set_field(L, "nodes", model.node_count());
  set_field(L, "springs", model.spring_count());
  set_field(L, "ends", model.end_count());
  set_field(L, "corners", model.corner_count());
  set_field(L, "border_nodes", border_count(model));
  set_field(L, "mass", properties.mass);
  set_field(L, "center_of_mass", properties.center);
  set_field(L, "inertia", properties.inertia);
  const double omega = elastic::largest_frequency(model);
  const double stable = elastic::stable_step(omega, elastic::largest_damping_time(model));
  const double undamped = elastic::stable_step(omega, 0);
  set_field(L, "stable_dt", stable);
  set_field(L, "undamped_dt", undamped);
  set_field(L, "limited_by", to_string(sim::stable_step_bound(stable, undamped)));
  set_field(L, "made_by", level.made_by);
  push_materials(L, model.materials);
  end_field(L, "materials");
  if (level.certificate) {
    push_certificate(L, level, *base_time);
    end_field(L, "certificate");
  }
}

int info_binding(Call& call) {
  const auto asset = call.value<ChainValue>(1);
  const std::vector<Level>& levels = asset->chain.levels;
  std::optional<sim::StepTime> base_time;
  if (std::any_of(levels.begin(), levels.end(),
                  [](const Level& level) { return level.certificate.has_value(); }))
    base_time = sim::step_time(levels.front().model, sim::Precision::double_precision);
  lua_State* L = call.lua();
  begin_table(L);
  begin_list(L, levels.size());
  for (std::size_t i = 0; i < levels.size(); ++i) {
    push_level_info(L, levels[i], i, base_time);
    end_list_entry(L, i + 1);
  }
  end_field(L, "levels");
  set_field(L, "contact", to_string(asset->chain.contact));
  push_provenance(L, asset->provenance);
  end_field(L, "provenance");
  set_field(L, "surface_triangles", asset->surface.triangles.size());
  return 1;
}

}  // namespace

void describe_assets(Api& api) {
  const Parameter chain{.name = "chain", .type = "LodChain", .help = "chain made by simplify"};
  api.add(FunctionEntry{
      .name = "save",
      .group = kGroup,
      .summary = "Writes a chain as one .glb asset that any glTF viewer shows.",
      .arguments = {{.name = "path", .type = "string", .help = "file to write, NAME.glb"}, chain},
      .options = {{.name = "command",
                   .type = "string",
                   .fallback = "none",
                   .help = "command that makes the chain again; it becomes the entry command of "
                           "its provenance, which springlod info prints"},
                  {.name = "slim",
                   .type = "boolean",
                   .fallback = "false",
                   .help = "whether to write only what an engine needs, in single precision: a "
                           "third of the bytes, without certificates"}},
      .returns = "nothing",
      .errors = "The file cannot be written; slim: single precision breaks a rule of models, as "
                "for small cells far from the origin.",
      .example = "s.save(\"out/dumbbell.glb\", chain)\n"
                 "s.save(\"out/dumbbell-slim.glb\", chain, {slim = true})",
      .call = save_binding});
  api.add(FunctionEntry{
      .name = "load",
      .group = kGroup,
      .summary = "Reads an asset back, bit for bit.",
      .arguments = {{.name = "path", .type = "string", .help = "NAME.glb that save wrote"}},
      .returns = "LodChain",
      .errors = "No such file, not a springlod asset, a damaged asset, or one of a newer version.",
      .example = "local chain = s.load(\"out/dumbbell.glb\")",
      .call = load_binding});
  api.add(FunctionEntry{
      .name = "info",
      .group = kGroup,
      .summary = "The content of a chain as plain tables.",
      .arguments = {chain},
      .returns =
          "table: levels (a list of level, nodes, springs, ends, corners, border_nodes, mass, "
          "center_of_mass, inertia, stable_dt [s], undamped_dt (stable_dt without damping) [s], "
          "limited_by (\"springs\" or \"damping\": what determines stable_dt), made_by, materials, "
          "certificate), provenance, "
          "surface_triangles; a level that was compared with the base has a Certificate",
      .errors = "None for a valid chain.",
      .example = "print(s.json(s.info(chain)))",
      .call = info_binding});
}

}  // namespace springlod::scripting
