#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.hpp"
#include "elastic/elastic_body.hpp"
#include "elastic/loads.hpp"
#include "lod/options.hpp"
#include "model/chain.hpp"

namespace springlod::lod {

/// Kinds of static loads. Each kind has its own weight and tolerance.
enum class LoadKind {
  smooth,  ///< on the whole body: smooth_loads
  piece,   ///< on one material region: piece_loads
  patch,   ///< on patches anywhere on the surface: patch_pairs, pinches and pushes
  region,  ///< within a TargetRegion of the surface: patch_pairs and pushes
};

/// A static load, and the base's compliance to it as a level can have it.
struct LoadTarget {
  LoadKind kind = LoadKind::smooth;
  elastic::StaticLoad load;  ///< on the base's nodes
  /// Work of the load along the means of the base's displacement over the groups of the level [J],
  /// above 0: see work_on_means. A level that had the whole compliance f.u of the base would move
  /// its nodes farther than their groups move, most of all where the surface is loaded at few
  /// nodes.
  double compliance = 0;
  double weight = 1;  ///< [1]
};

/// Targets of the fit of one level: natural frequencies, mode shapes and static compliances of the
/// base (docs/method.md, eq. 30 and the table of weights below it).
struct ElasticTargets {
  std::vector<double> squared_frequency;  ///< omega^2 of the lowest modes, ascending [rad2/s2]
  double mode_weight = 1;                 ///< factor on the default weight of each frequency [1]
  /// Inertial forces M phi of each mode on the base's nodes [kg^1/2], which stand for its shape;
  /// none if shape_weight is 0.
  std::vector<std::vector<Vec3>> modal_forces;
  double shape_weight = 1;  ///< factor on the default weight of the shapes [1]
  std::vector<LoadTarget> loads;
  double highest_frequency = 0;  ///< omega_max of the base [rad/s]
  std::uint32_t nodes = 0;       ///< number of nodes of the base
  Support anchored;              ///< of the base
};

/// Number of modes to fit: 0 if options.kinds is loads.
std::uint32_t mode_count(const TargetOptions& options);
/// Number of patch loads for a base of `nodes` nodes: options.patches if set, otherwise 150,
/// falling to 60 for large bases (docs/method.md, eq. 31). Large models do not overfit to a few
/// patches, so fewer patch load cases suffice.
std::uint32_t patch_count(const TargetOptions& options, std::uint32_t nodes);

/// StaticOptions::relative_tolerance in a calibration: leaves less than 0.01 % of error in a
/// compliance.
constexpr double kLoadBalance = 1e-8;

/// Measured values of a base. Measuring a large base takes minutes.
struct BaseMeasurements {
  std::vector<double> squared_frequency;        ///< as in ElasticTargets [rad2/s2]
  std::vector<std::vector<Vec3>> modal_forces;  ///< as in ElasticTargets [kg^1/2]
  /// LoadTarget::compliance of every target load, by level; 0: the load does not act [J].
  std::vector<std::vector<double>> compliance;
  double highest_frequency = 0;  ///< omega_max [rad/s]
};

/// Measures the targets of a base for the level of groups `of_base`. Half of the loads of a region
/// are patch pairs, if two patches fit into it; the others push one patch against the inertia of
/// the body or against its anchors. A region without free border nodes adds no loads. Throws
/// InputError for weights below 0, and where elastic_body does.
ElasticTargets measure_targets(const MassSpringModel& base, const Groups& of_base,
                               const TargetOptions& options = {});

/// The three steps of measure_targets, for callers that store the measurements: the loads, with
/// compliances still 0; the measurements for several levels, which do not depend on the weights;
/// the targets of one of these levels, counted from 0.
std::vector<LoadTarget> target_loads(const MassSpringModel& base, const TargetOptions& options);
BaseMeasurements measure_base(const MassSpringModel& base, const TargetOptions& options,
                              const std::vector<LoadTarget>& loads,
                              const std::vector<Groups>& levels);
ElasticTargets make_targets(const MassSpringModel& base, const TargetOptions& options,
                            std::vector<LoadTarget> loads, const BaseMeasurements& measured,
                            std::size_t level);

/// Nodes of the region that loads can act on: border nodes that are not anchored.
std::vector<std::uint32_t> movable_nodes(const MassSpringModel& base, const TargetRegion& region,
                                         const Support& anchored);

/// The load on a level's nodes: the forces on the base nodes summed over each group [N].
elastic::StaticLoad summed_over_groups(const Groups& of_base, const elastic::StaticLoad& load);

}  // namespace springlod::lod
