#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/binding.hpp"
#include "model/certificate.hpp"
#include "model/mass_spring.hpp"
#include "model/mesh.hpp"

namespace springlod::inline model {

/// Which coarse node each fine node went into. Every number below `count` occurs.
struct Groups {
  std::vector<std::uint32_t> of;  ///< fine node -> coarse node
  std::uint32_t count = 0;
};

/// Every node its own group.
Groups identity_groups(std::uint32_t node_count);
/// `finer` first, then `coarser`: merges made level by level compose.
Groups compose(const Groups& finer, const Groups& coarser);
/// The coarse nodes that hold at least one of the fine `nodes`: rising, each once. So an anchored
/// group is one of which any node was anchored. Throws InputError for a node not in the map.
std::vector<std::uint32_t> carried(const Groups& groups, const std::vector<std::uint32_t>& nodes);
/// Throws InputError unless every group number is below count and occurs.
void validate(const Groups& groups);

/// One model of a chain and the map from every level-0 node to its node. How the level was made is
/// told in `made_by` ("priority soft, border weak, seed 1").
struct Level {
  MassSpringModel model;
  Groups of_base;
  std::string made_by;
  std::optional<Certificate> certificate{};  ///< what it was measured to be, if it was
};

/// Levels 0..n, 0 = base = finest.
struct LodChain {
  std::vector<Level> levels;
};

/// Where an artefact came from: enough to make it again. Ordered, no clock times (the same input
/// gives the same bits).
struct Provenance {
  std::vector<std::pair<std::string, std::string>> entries;
  void set(const std::string& key, const std::string& value);
};

/// A chain with everything needed to draw it: what one .glb asset holds.
struct LodAsset {
  LodChain chain;
  TriangleMesh surface;     ///< the original mesh; may be empty
  Binding surface_of_base;  ///< surface vertices from level-0 nodes; empty if there is no surface
  Provenance provenance;
};

/// Throws InputError naming the level and the rule that is broken.
void validate(const LodAsset& asset);

}  // namespace springlod::inline model
