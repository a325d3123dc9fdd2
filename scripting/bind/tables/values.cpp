#include "scripting/bind/tables/values.hpp"

#include <fmt/format.h>

#include "lod/transfer.hpp"
#include "voxelize/cells/depth.hpp"

namespace springlod::scripting {

std::shared_ptr<const sim::ContactSkin> ChainValue::skin(std::uint32_t level) const {
  const std::scoped_lock lock(mutex_);
  skins_.resize(chain.levels.size());
  std::shared_ptr<const sim::ContactSkin>& skin = skins_.at(level);
  if (!skin) skin = std::make_shared<const sim::ContactSkin>(sim::contact_skin(chain, level));
  return skin;
}

std::shared_ptr<const ModelValue> level_value(const std::shared_ptr<const ChainValue>& chain,
                                              std::uint32_t level) {
  auto value = std::make_shared<ModelValue>();
  const Level& found = chain->chain.levels.at(level);
  value->model = std::shared_ptr<const MassSpringModel>(chain, &found.model);
  if (chain->surface_of_base.point_count() > 0) {
    value->surface = std::shared_ptr<const TriangleMesh>(chain, &chain->surface);
    value->surface_of_base = std::shared_ptr<const Binding>(chain, &chain->surface_of_base);
  }
  value->chain = chain;
  value->level = level;
  value->made_by = found.made_by;
  value->provenance = chain->provenance;
  return value;
}

voxelize::MaterialGrid with_depth(const GridValue& value) {
  voxelize::MaterialGrid grid = value.grid;
  if (value.voxelized && grid.depth.empty())
    grid.depth = voxelize::measure_depth(grid, value.mesh->mesh);
  return grid;
}

Binding surface_binding(const ModelValue& model) {
  if (!model.surface_of_base) return {};
  if (!model.chain || model.level == 0) return *model.surface_of_base;
  return compose(*model.surface_of_base, lod::base_from_level(model.chain->chain, model.level));
}

}  // namespace springlod::scripting
