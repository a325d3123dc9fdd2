#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "model/binding.hpp"
#include "model/chain.hpp"
#include "model/mesh.hpp"
#include "report/stats.hpp"
#include "scripting/engine/value.hpp"
#include "sim/run.hpp"
#include "sim/scenario.hpp"
#include "sim/study/compare.hpp"
#include "voxelize/grid.hpp"
#include "voxelize/mesh/import.hpp"

namespace springlod::sim {
struct StabilityMap;
}

namespace springlod::scripting {

// Values of scripts: objects of springlod with their provenance. Values are shared and immutable.

struct MeshValue {
  TriangleMesh mesh;
  voxelize::ImportReport report;
  Provenance provenance;
};
template <>
inline constexpr const char* kValueName<MeshValue> = "Mesh";

struct GridValue {
  voxelize::MaterialGrid grid;
  std::shared_ptr<const MeshValue> mesh;  ///< drawn instead of the grid; null for a loaded grid
  bool voxelized = false;                 ///< filled from `mesh`, so depths can be measured
  Provenance provenance;
};
/// The grid with the depths of its cells, if they are known or can be measured.
voxelize::MaterialGrid with_depth(const GridValue& value);
template <>
inline constexpr const char* kValueName<GridValue> = "Grid";

/// A chain with the contact skins of its levels.
class ChainValue : public LodAsset {
 public:
  ChainValue() = default;
  explicit ChainValue(LodAsset asset) : LodAsset(std::move(asset)) {}

  /// sim::contact_skin of a level above 0. It is laid out once, for all runs of the level: the
  /// chain, like every value, does not change any more. May be called by several threads.
  std::shared_ptr<const sim::ContactSkin> skin(std::uint32_t level) const;

 private:
  mutable std::mutex mutex_;
  mutable std::vector<std::shared_ptr<const sim::ContactSkin>> skins_;  // by level; null until laid
};
template <>
inline constexpr const char* kValueName<ChainValue> = "LodChain";

/// A separate model, or a level of a chain (then `chain` owns it).
struct ModelValue {
  std::shared_ptr<const MassSpringModel> model;
  std::shared_ptr<const TriangleMesh> surface;     ///< null if there is none
  std::shared_ptr<const Binding> surface_of_base;  ///< null if there is none
  std::shared_ptr<const ChainValue> chain;         ///< null for a model of its own
  std::uint32_t level = 0;
  std::string made_by;
  Provenance provenance;
};
template <>
inline constexpr const char* kValueName<ModelValue> = "Model";

template <>
inline constexpr const char* kValueName<sim::Scenario> = "Scenario";

struct TrajectoryValue {
  sim::Trajectory trajectory;
  std::shared_ptr<const ModelValue> model;
  std::shared_ptr<const sim::Scenario> scenario;
  std::vector<std::string> anchor_names;  ///< in the order of Trajectory::anchor_loads
};
template <>
inline constexpr const char* kValueName<TrajectoryValue> = "Trajectory";

struct ComparisonValue {
  sim::Comparison comparison;
  std::shared_ptr<const ChainValue> chain;
};
template <>
inline constexpr const char* kValueName<ComparisonValue> = "Comparison";

template <>
inline constexpr const char* kValueName<sim::StabilityMap> = "StabilityMap";

template <>
inline constexpr const char* kValueName<report::NoiseFloor> = "NoiseFloor";

/// Level `level` of a chain as a model.
std::shared_ptr<const ModelValue> level_value(const std::shared_ptr<const ChainValue>& chain,
                                              std::uint32_t level);

/// Surface vertices from the nodes of the model; empty if it has no surface.
Binding surface_binding(const ModelValue& model);

}  // namespace springlod::scripting
