// Random-node models, and levels made by refilling a grid with fewer nodes.

#include "voxelize/random/random.hpp"

#include <utility>

#include <fmt/format.h>
#include <lua.hpp>

#include "lod/refill.hpp"
#include "scripting/bind/tables/options.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "voxelize/refill.hpp"

namespace springlod::scripting {

namespace {

int random_binding(Call& call) {
  const auto grid = call.value<GridValue>(1);
  voxelize::RandomOptions options;
  options.seed = call.session().settings().seed;
  TableReader reader = call.options(2);
  read_options(call, reader, options);
  reader.finish();
  options.progress = call.progress();

  voxelize::RandomModel random = voxelize::build_random(grid->grid, options);
  if (random.components > 1)
    call.session().console().say(fmt::format("{} parts that no spring joins", random.components));
  auto value = std::make_shared<ModelValue>();
  value->made_by = fmt::format("random, {} nodes, {} ends, seed {}{}", random.model.node_count(),
                               options.ends, options.seed, options.rescale ? "" : ", not rescaled");
  value->model = std::make_shared<const MassSpringModel>(std::move(random.model));
  value->provenance = grid->provenance;
  value->provenance.set("random", value->made_by);
  if (!options.volumes) value->provenance.set("volumes", "false");
  value->provenance.set("rescaled", fmt::format("{:.6g}", random.rescaled));
  value->provenance.set("measured_young", fmt::format("{:.6g} of the materials'", random.young));
  value->provenance.set("measured_poisson", fmt::format("{:.6g}", random.poisson));
  if (grid->mesh) {
    value->surface = std::shared_ptr<const TriangleMesh>(grid->mesh, &grid->mesh->mesh);
    value->surface_of_base =
        std::make_shared<const Binding>(bind_points(value->surface->positions, *value->model));
  }
  return call.give(std::shared_ptr<const ModelValue>(value));
}

// A count, or a list of them. Counts beyond that of the base would take its memory many times over
// before the level is refused as finer than its base.
std::vector<std::uint32_t> read_counts(TableReader& reader, std::uint32_t base_nodes) {
  const int given = reader.raw("nodes");
  if (given == 0) reader.refuse("nodes", "given: how many each level shall have, as in {161, 78}");
  std::vector<std::uint32_t> counts(1);
  lua_istable(reader.lua(), given) ? reader.read("nodes", counts)
                                   : reader.read("nodes", counts.front());
  for (const std::uint32_t count : counts)
    if (count > base_nodes)
      reader.refuse("nodes", fmt::format("at most {}, the number of the base's nodes, got {}",
                                         base_nodes, count));
  return counts;
}

int refill_binding(Call& call) {
  const auto base = call.value<ModelValue>(1);
  if (base->chain && base->level != 0)
    call.refuse(1, "a base model (level 0); a coarser level cannot be the base of a chain");
  const auto grid = call.value<GridValue>(2);
  voxelize::RefillOptions options;
  options.seed = call.session().settings().seed;
  TableReader reader = call.options(3);
  options.nodes = read_counts(reader, base->model->node_count());
  read_options(call, reader, options);
  reader.finish();
  options.progress = call.progress();

  auto asset = std::make_shared<ChainValue>();
  asset->chain = lod::refill(*base->model, voxelize::refill_levels(grid->grid, options));
  for (std::size_t n = 0; n < options.nodes.size(); ++n) {
    const std::uint32_t reached = asset->chain.levels[n + 1].model.node_count();
    if (reached != options.nodes[n])
      call.session().console().say(
          fmt::format("level {}: {} nodes, the nearest to {} that a "
                      "lattice has",
                      n + 1, reached, options.nodes[n]));
  }
  if (base->surface) {
    asset->surface = *base->surface;
    asset->surface_of_base = *base->surface_of_base;
  }
  asset->provenance = base->provenance;
  asset->provenance.set("refill", asset->chain.levels.back().made_by);
  if (!options.volumes) asset->provenance.set("refill_volumes", "false");
  return call.give(std::shared_ptr<const ChainValue>(asset));
}

std::vector<Parameter> refill_parameters() {
  std::vector<Parameter> parameters = session_parameters<voxelize::RefillOptions>();
  parameters.insert(parameters.begin(),
                    {.name = "nodes",
                     .type = "integer or list of integers",
                     .range = Range{1, voxelize::kMostRandomNodes},
                     .help = "number of nodes of level 1, 2, ...; a lattice has the nearest "
                             "possible number"});
  return parameters;
}

}  // namespace

void describe_random(Api& api) {
  api.add(FunctionEntry{
      .name = "random",
      .group = "From mesh to model",
      .summary = "Builds a model of any number of randomly placed nodes in a grid.",
      .arguments = {{.name = "grid", .type = "Grid", .help = "filled cells"}},
      .options = session_parameters<voxelize::RandomOptions>(),
      .returns = "Model: with the mesh's surface bound to its nodes; its provenance has the "
                 "measured moduli",
      .errors = "An empty grid, fewer than 15 nodes or 14 ends, more nodes than there is room for.",
      .example = "local base = s.random(grid, {nodes = 1000, seed = 1})",
      .call = random_binding});
}

void describe_refill(Api& api) {
  api.add(FunctionEntry{
      .name = "refill",
      .group = "Levels of detail",
      .summary =
          "Global rescaling: makes a chain whose coarser levels are new models of the same volume.",
      .arguments = {{.name = "model", .type = "Model", .help = "the base: level 0"},
                    {.name = "grid",
                     .type = "Grid",
                     .help = "the grid from which the base was made"}},
      .options = refill_parameters(),
      .returns = "LodChain: each base node belongs to the nearest node of a level",
      .errors = "A level that would be no coarser than the one before.",
      .example = "local chain = s.refill(base, grid, {nodes = {161, 78}, style = \"random\"})",
      .call = refill_binding});
}

}  // namespace springlod::scripting
