#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/choice.hpp"
#include "base/option.hpp"
#include "base/progress.hpp"
#include "elastic/elastic_body.hpp"
#include "elastic/loads/static_loads.hpp"
#include "model/anchors.hpp"
#include "model/chain.hpp"

namespace springlod {

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
  StaticLoad load;        ///< on the base's nodes
  double compliance = 0;  ///< of the base [J] > 0
  double weight = 1;      ///< [1]
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

/// Part of a body that a level shall give way in as the base does, such as where it will touch the
/// ground or next to where it is held.
struct TargetRegion {
  std::vector<std::uint32_t> nodes;  ///< of the base; those on the border count
  double weight = 1;                 ///< of each load, where a smooth one has 1
  std::uint32_t patches = 40;        ///< loads on patches within it
};
constexpr auto option_rows(const TargetRegion*) {
  return std::tuple(
      nodes_option("nodes", &TargetRegion::nodes,
                   "of the base: their numbers, or a function of a Node that returns true for "
                   "them; those on the border that are not anchored count"),
      option("weight", &TargetRegion::weight, "of each load on it, where a smooth load has 1")
          .weight(),
      option("patches", &TargetRegion::patches,
             "loads on patches within it: half of them pairs that are pulled apart, if there is "
             "room, the others pushed against the body's inertia"));
}

/// What shall be as in the base.
enum class TargetKinds {
  both,
  modes,
  loads,
};

inline constexpr Choice<TargetKinds> kTargetKinds[] = {
    {TargetKinds::both, "both", "the lowest modes and static loads"},
    {TargetKinds::modes, "modes", "the lowest modes alone"},
    {TargetKinds::loads, "loads", "static loads alone"}};
constexpr ChoiceTable<Choice<TargetKinds>> choices(TargetKinds) {
  return {"targets", kTargetKinds};
}

struct TargetOptions {
  /// Loads are the nine of smooth_loads, piece_loads, and those on patches and regions.
  TargetKinds kinds = TargetKinds::both;
  std::uint32_t modes = 20;
  double piece_weight = 0.3;  ///< of each of piece_loads, where one of the nine has 1
  /// Pairs of opposed loads on patches of the surface, see patch_pairs: without them what is not
  /// fitted gets worse than it was.
  /// None named: see patch_count.
  std::optional<std::uint32_t> patches = {};
  double patch_weight = 0.2;
  std::vector<TargetRegion> regions = {};
  /// How much modes and static loads of every kind count, over what they usually do.
  double mode_weight = 1, load_weight = 1;
  std::uint64_t seed = 1;                    ///< of the patches
  std::vector<std::uint32_t> anchored = {};  ///< nodes of the base that are held
  std::uint32_t threads = 1;                 ///< up to two are used; the same bits for any number
  Progress* progress = nullptr;              ///< may be null
};
constexpr auto option_rows(const TargetOptions*) {
  return std::tuple(
      option("targets", &TargetOptions::kinds, "what shall be as in the base"),
      option("modes", &TargetOptions::modes, "how many of the lowest frequencies"),
      option("patches", &TargetOptions::patches,
             "pairs of patches of the surface that are pulled apart, besides the nine smooth loads")
          .by_default("150, down to 60 for a base of more than 2000 nodes"),
      option("patch_weight", &TargetOptions::patch_weight,
             "of each of them, where a smooth load has 1")
          .weight(),
      record_option("regions", &TargetOptions::regions, "Region",
                    "parts of the surface that matter, with loads of their own", "none"),
      option("mode_weight", &TargetOptions::mode_weight,
             "how much modes count, over what they usually do")
          .weight(),
      option("load_weight", &TargetOptions::load_weight,
             "how much static loads of every kind count, over what they usually do")
          .weight(),
      option("seed", &TargetOptions::seed, "of the patches"),
      anchored_option(&TargetOptions::anchored));
}

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
ElasticBody held_body(const MassSpringModel& model, const std::vector<std::uint32_t>& anchored,
                      Progress* progress = nullptr);

/// The region's nodes that loads can move: on the border and not anchored.
std::vector<std::uint32_t> movable_nodes(const MassSpringModel& base, const TargetRegion& region,
                                         const std::vector<std::uint32_t>& anchored);

/// Forces on the nodes of a level, from those on the base's nodes.
StaticLoad carried(const Groups& of_base, const StaticLoad& load);

}  // namespace springlod
