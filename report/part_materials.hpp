#pragma once

#include <cstdint>
#include <vector>

#include "model/binding.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"
#include "model/mesh.hpp"

namespace springlod::report {

/// The material of each part of a surface that is bound to the nodes of a model, as an index into
/// the materials of the model: the one that has the name of the part or of its material in the mesh
/// file; if there is none, that with most of the weights by which the part's vertices are bound.
std::vector<std::uint32_t> part_materials(const TriangleMesh& surface,
                                          const Binding& surface_of_nodes,
                                          const MassSpringModel& model);
/// The same of an asset's surface and its base.
std::vector<std::uint32_t> part_materials(const LodAsset& asset);

}  // namespace springlod::report
