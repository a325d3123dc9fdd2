#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/progress.hpp"
#include "elastic/elastic_body.hpp"
#include "elastic/loads.hpp"
#include "lod/options.hpp"
#include "model/chain.hpp"

namespace springlod::lod {

/// What a load asks about. Each kind has a weight and a tolerance of its own.
enum class LoadKind {
  smooth,  ///< the whole body: smooth_loads
  piece,   ///< pieces of one material: piece_loads
  patch,   ///< the surface, anywhere: patch_pairs
  region,  ///< a part of the surface that matters: patch_pairs and pushes within it
};

/// A load and how far the base gives way to it.
struct LoadTarget {
  LoadKind kind = LoadKind::smooth;
  elastic::StaticLoad load;  ///< on the base's nodes
  double compliance = 0;     ///< of the base [J] > 0
  double weight = 1;         ///< [1]
};

/// What a level shall have in common with its base (spec 4.1), measured on the base once.
struct ElasticTargets {
  std::vector<double> squared_frequency;  ///< of the lowest modes, rising [rad2/s2]
  double mode_weight = 1;                 ///< of each of them, over the usual one [1]
  std::vector<LoadTarget> loads;
  double highest_frequency = 0;         ///< omega_max of the base [rad/s]
  std::uint32_t nodes = 0;              ///< of the base
  std::vector<std::uint32_t> anchored;  ///< nodes of the base
};

/// Modes that are asked for: none if loads alone are.
std::uint32_t mode_count(const TargetOptions& options);
/// Pairs of patches for a base of so many nodes: 150, and fewer for more than 2000 nodes, which a
/// fit does not bend for the loads of some patches as those of a small body, down to 60.
std::uint32_t patch_count(const TargetOptions& options, std::uint32_t nodes);

/// StaticOptions::balance of loads in a calibration: leaves compliances right to a hundredth of a
/// percent and better.
constexpr double kLoadBalance = 1e-8;

/// What is measured of a base, which takes long where it is large.
struct BaseAnswers {
  std::vector<double> squared_frequency;  ///< as in ElasticTargets
  std::vector<double> compliance;         ///< of every load asked, also where it is 0 [J]
  double highest_frequency = 0;           ///< omega_max [rad/s]
};

/// Of a region half the loads are pairs of patches if there is room for two of them, the others
/// patches that are pushed against the inertia of the body, or whatever holds it. A region without
/// border nodes that are free to move adds none.
/// Throws InputError for weights below 0, and where elastic_body does.
ElasticTargets measure_targets(const MassSpringModel& base, const TargetOptions& options = {});

/// Its parts, for those who keep the answers: the loads, whose compliances are yet to be measured;
/// what is measured of the base, in which the weights have no part; and both together.
std::vector<LoadTarget> asked_loads(const MassSpringModel& base, const TargetOptions& options);
BaseAnswers measure_base(const MassSpringModel& base, const TargetOptions& options,
                         const std::vector<LoadTarget>& asked);
ElasticTargets targets_of(const MassSpringModel& base, const TargetOptions& options,
                          std::vector<LoadTarget> asked, const BaseAnswers& answers);

/// The body held at the anchored nodes; what they leave free is balanced by its inertia, as if
/// there were none, and not refused.
elastic::ElasticBody held_body(const MassSpringModel& model,
                               const std::vector<std::uint32_t>& anchored,
                               Progress* progress = nullptr);

/// The region's nodes that loads can move: on the border and not anchored.
std::vector<std::uint32_t> movable_nodes(const MassSpringModel& base, const TargetRegion& region,
                                         const std::vector<std::uint32_t>& anchored);

/// Forces on the nodes of a level, from those on the base's nodes.
elastic::StaticLoad carried(const Groups& of_base, const elastic::StaticLoad& load);

}  // namespace springlod::lod
