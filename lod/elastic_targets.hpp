#pragma once

#include <cstdint>
#include <vector>

#include "model/chain.hpp"
#include "model/elastic_body.hpp"
#include "model/progress.hpp"
#include "model/static_loads.hpp"

namespace springlod {

/// A load and how far the base gives way to it.
struct LoadTarget {
  StaticLoad load;        ///< on the base's nodes
  double compliance = 0;  ///< of the base [J] > 0
  double weight = 1;      ///< [1]
};

/// What a level shall have in common with its base (spec 4.1), measured on the base once.
struct ElasticTargets {
  std::vector<double> squared_frequency;  ///< of the lowest modes, rising [rad2/s2]
  std::vector<LoadTarget> loads;          ///< the smooth ones on the whole body first
  std::size_t smooth_loads = 0;           ///< how many those are
  double highest_frequency = 0;           ///< omega_max of the base [rad/s]
  std::uint32_t nodes = 0;                ///< of the base
  std::vector<std::uint32_t> anchored;    ///< nodes of the base
};

struct TargetOptions {
  std::uint32_t modes = 20;
  bool smooth_loads = true;   ///< the nine of smooth_loads, and piece_loads
  double piece_weight = 0.3;  ///< of each of the latter, where one of the nine has 1
  /// Pairs of opposed loads on patches of the surface, see patch_pairs: without them what is not
  /// fitted gets worse than it was.
  std::uint32_t patches = 150;
  double patch_weight = 0.2;
  std::uint64_t seed = 1;                    ///< of the patches
  std::vector<std::uint32_t> anchored = {};  ///< nodes of the base that are held
  Progress* progress = nullptr;              ///< may be null
};

ElasticTargets measure_targets(const MassSpringModel& base, const TargetOptions& options = {});

/// The body held at the anchored nodes; what they leave free is balanced by its inertia, as if
/// there were none, and not refused.
ElasticBody held_body(const MassSpringModel& model, const std::vector<std::uint32_t>& anchored,
                      Progress* progress = nullptr);

/// Forces on the nodes of a level, from those on the base's nodes.
StaticLoad carried(const Groups& of_base, const StaticLoad& load);

}  // namespace springlod
