#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/binding.hpp"
#include "model/certificate.hpp"
#include "model/contact_at.hpp"
#include "model/mass_spring.hpp"
#include "model/mesh.hpp"

namespace springlod::inline model {

/// Map from fine nodes to the coarse nodes they were merged into. Every coarse number below `count`
/// occurs.
struct Groups {
  std::vector<std::uint32_t> of;  ///< fine node -> coarse node
  std::uint32_t count = 0;
};

/// The identity map.
Groups identity_groups(std::uint32_t node_count);
/// The map `coarser` after `finer`. Throws InputError if `coarser` maps other nodes than `finer`
/// makes.
Groups compose(const Groups& finer, const Groups& coarser);
/// The coarse nodes that the fine `nodes` were merged into, ascending, each once. Therefore, a
/// group is anchored if any of its nodes is. Throws InputError for a node that is not in the map.
std::vector<std::uint32_t> mapped_nodes(const Groups& groups,
                                        const std::vector<std::uint32_t>& nodes);
/// Throws InputError unless every group number is below count and occurs.
void validate(const Groups& groups);

/// A model of a chain and the map from each level-0 node to a node of the model. `made_by`
/// describes how the level was made ("priority soft, border weak, seed 1").
struct Level {
  MassSpringModel model;
  Groups of_base;
  std::string made_by;
  std::optional<Certificate> certificate{};  ///< if the level was measured
};

/// Levels from fine to coarse; level 0 is the base.
struct LodChain {
  std::vector<Level> levels;
  ContactAt contact = ContactAt::nodes;  ///< where its levels touch obstacles, unless a run asks
};

/// Throws InputError for a level that the chain does not have.
const Level& level_at(const LodChain& chain, std::uint32_t level);

/// Origin of an artefact: enough to make it again. Ordered, without clock times (the same input
/// gives the same bits).
struct Provenance {
  std::vector<std::pair<std::string, std::string>> entries;
  void set(const std::string& key, const std::string& value);
};

/// A chain with everything needed to draw it: the contents of one .glb asset.
struct LodAsset {
  LodChain chain;
  TriangleMesh surface;     ///< the original mesh; may be empty
  Binding surface_of_base;  ///< maps level-0 nodes to surface vertices; may be empty
  Provenance provenance;
};

/// Throws InputError with the level and the rule that it breaks.
void validate(const LodAsset& asset);

}  // namespace springlod::inline model
