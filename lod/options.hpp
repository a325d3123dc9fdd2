#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/choice.hpp"
#include "base/option.hpp"
#include "base/progress.hpp"
#include "model/anchors.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"

// What can be asked of simplify, step by step: groups, merging, guards, calibration.
namespace springlod::lod {

struct GroupingTask;

/// Which nodes merge; what each means stands in its row, see choices(Grouping).
enum class Grouping { standard, priority_soft, priority_hard, compact, metis };

/// A row of the table of groupings.
struct GroupingChoice : Choice<Grouping> {
  Groups (*make)(const GroupingTask& task);
  struct Traits {
    /// Makes as many groups as wanted, so that every level is merged straight from the base. The
    /// others make what they make, from the level before.
    bool from_base = false;
    bool follows_border = true;  ///< keeps BorderRule
  } traits = {};
};
ChoiceTable<GroupingChoice> choices(Grouping);
/// What scripts may ask of a grouping.
constexpr auto choice_traits(const GroupingChoice& row) {
  return std::array{std::pair("from_base", row.traits.from_base),
                    std::pair("follows_border", row.traits.follows_border)};
}

/// What may happen to border nodes (5.3).
enum class BorderRule {
  none,
  /// Border nodes merge only with border nodes; a node whose best candidate is of the other kind
  /// skips its own turn, yet others may pick it.
  weak,
  strong,  ///< border nodes never merge
};

inline constexpr Choice<BorderRule> kBorderRules[] = {
    {BorderRule::none, "none", "border nodes merge freely"},
    {BorderRule::weak, "weak", "border nodes merge only with border nodes"},
    {BorderRule::strong, "strong", "border nodes never merge"}};
constexpr ChoiceTable<Choice<BorderRule>> choices(BorderRule) {
  return {"border", kBorderRules};
}

/// Lower goes first. Called once a node.
using NodePriority = std::function<double(std::uint32_t node)>;
/// Lower goes first; NaN or infinity forbids the pair. Called once a spring, with a < b.
using PairCost = std::function<double(std::uint32_t a, std::uint32_t b)>;

struct GroupingOptions {
  Grouping grouping = Grouping::standard;
  BorderRule border = BorderRule::none;
  std::uint64_t seed = 1;
  double grading = 0.5;          ///< of compact groups by stiffness, see graded_shares
  NodePriority node_priority{};  ///< replaces the order in which nodes are visited
  PairCost pair_cost{};          ///< replaces the key by which neighbours are chosen
};
constexpr auto option_rows(const GroupingOptions*) {
  return std::tuple(
      option("grouping", &GroupingOptions::grouping, "which nodes merge"),
      option("border", &GroupingOptions::border, "what may happen to border nodes"),
      option("seed", &GroupingOptions::seed,
             "of the random order; the same seed gives the same bits"),
      option("grading", &GroupingOptions::grading,
             "of compact: 0 .. 1, by how much stiff materials get larger groups than soft ones, "
             "for a longer step"));
}

/// Where the mass of a body goes when its nodes merge (the paper, section 4.2 and figure 2).
enum class MassRule {
  proportional,  ///< a node has the masses of its group
  /// Each piece of the body goes to the nearest node, so masses also shift to neighbours that did
  /// not merge.
  proximity,
};

inline constexpr Choice<MassRule> kMassRules[] = {
    {MassRule::proportional, "proportional", "a node has the masses of its group"},
    {MassRule::proximity, "proximity", "each piece of the base goes to the nearest node"}};
constexpr ChoiceTable<Choice<MassRule>> choices(MassRule) {
  return {"mass", kMassRules};
}

struct GuardOptions {
  /// Joined groups nearer than this part of the fine model's mean spring length are fused
  /// (coincident centroids would give k = infinity). Spec 3.
  double coincident_fraction = 0.25;
  /// A node with fewer springs is floppy and is fused with its nearest neighbour.
  std::uint32_t least_springs = 4;
  /// A node is floppy too if lambda_min / lambda_max of sum k u u^T is below this: its springs lie
  /// nearly in one plane.
  double least_rigidity = 1e-3;
  BorderRule border = BorderRule::none;  ///< strong: only inner nodes are fused
};
constexpr auto option_rows(const GuardOptions*) {
  return std::tuple(
      option("coincident_fraction", &GuardOptions::coincident_fraction,
             "joined nodes nearer than this part of the mean spring length are fused"),
      option("least_springs", &GuardOptions::least_springs, "a node with fewer springs is floppy"),
      option("least_rigidity", &GuardOptions::least_rigidity,
             "a node is floppy if lambda_min / lambda_max of its springs' sum k u u^T is below"));
}

/// Whose moments are kept while masses shift between nodes.
enum class KeptMoments {
  body,   ///< those of the whole
  pieces  ///< also those of each piece: connected nodes of one material, 20 or more
};

inline constexpr Choice<KeptMoments> kKeptMoments[] = {
    {KeptMoments::body, "body", "those of the whole body"},
    {KeptMoments::pieces, "pieces",
     "those of each of its pieces of one material too: more accurate in impacts, shorter stable "
     "time step"}};
constexpr ChoiceTable<Choice<KeptMoments>> choices(KeptMoments) {
  return {"moments", kKeptMoments};
}

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

struct FitOptions {
  /// Steps at most; 0: 90 for up to 500 nodes, down to 10 for large levels, see fit_steps.
  std::uint32_t iterations = 0;
  /// Mean error of the ten lowest frequencies that is good enough [1], 0: see frequency_tolerance;
  /// the other modes may miss by four times as much, smooth loads and those of regions by eight,
  /// loads of patches and pieces by twenty times as much.
  double tolerance = 0;
  /// Where the largest frequency need not fall any further, over that of a lattice of as many
  /// nodes, omega0 (N / N0)^(1/3): below it local loads are answered worse.
  double least_frequency = 0.85;
  /// Of pieces too: how a body moves when it is hit in one place then is more like its base, its
  /// largest frequency less low, for the nodes that are stiff may not be given the others' mass.
  KeptMoments moments = KeptMoments::body;
  std::uint32_t threads = 1;  ///< up to two are used; the same bits for any number
};
constexpr auto option_rows(const FitOptions*) {
  return std::tuple(
      option(
          "tolerance", &FitOptions::tolerance,
          "mean error of the ten lowest frequencies that is good enough; other modes may miss by "
          "four times as much, smooth loads and regions by eight, patches by twenty")
          .by_default("0.002 sqrt(N0 / N)"),
      option("iterations", &FitOptions::iterations,
             "steps at most; by itself fewer for levels of more than 500 nodes, down to 10")
          .by_default("90"),
      option("least_frequency", &FitOptions::least_frequency,
             "where the largest frequency, which bounds the step, need not fall any further, over "
             "that of a lattice of as many nodes"),
      option("moments", &FitOptions::moments,
             "masses shift between nodes; which mass, centre and second moments stay"));
}

/// What is done to levels after merging.
enum class Calibrate {
  none,    ///< as they were merged (the paper)
  moduli,  ///< see rescale_moduli
  modes,   ///< see calibrate
};

/// A row of its words, with what a level says of how it was made.
struct CalibrateChoice : Choice<Calibrate> {
  const char* remark;
};
inline constexpr CalibrateChoice kCalibrate[] = {
    {{Calibrate::none, "none", "levels stay as they were merged"}, ""},
    {{Calibrate::moduli, "moduli", "levels get the moduli of eq. 2 of the paper"},
     ", moduli rescaled"},
    {{Calibrate::modes, "modes",
      "levels get the base's frequencies and compliances, with as long a step as that allows, and "
      "carry a certificate of it"},
     ", calibrated"}};
constexpr ChoiceTable<CalibrateChoice> choices(Calibrate) {
  return {"calibrate", kCalibrate};
}

struct CalibrateOptions {
  TargetOptions targets{};
  FitOptions fit{};
  /// Folder that keeps what was found so far (CalibrationStore): a calibration that was stopped
  /// goes on from there when it is made again, to the same bits. Empty: nothing is kept.
  std::filesystem::path store{};
  /// Time between two writes of a fit's state to the store [s], 0: after each step. A step of a
  /// large level takes seconds, its state is some megabytes. A fit that is interrupted or done
  /// writes its state in any case; one that is killed loses the steps since the last write.
  double keep_every = 2;
  /// Levels that are fitted at a time, 0: as many as cores; of more than one each may take a second
  /// thread, for the levels differ much in size.
  std::uint32_t threads = 1;
  Progress* progress = nullptr;  ///< may be null
};
constexpr auto option_rows(const CalibrateOptions*) {
  return std::tuple(
      nested(&CalibrateOptions::targets), nested(&CalibrateOptions::fit),
      option("store", &CalibrateOptions::store,
             "folder that keeps what was found so far: a call that was stopped, or killed, goes on "
             "from there when it is made again, to the same bits; what is of another base, level "
             "or options is not used")
          .by_default("none"),
      option("keep_every", &CalibrateOptions::keep_every,
             "time between two writes of a fit's state to the store, 0: after each step; a "
             "calibration that is killed loses so much, one that is stopped with Ctrl-C nothing")
          .in(Dimension::time));
}

/// Makes the groups of one level from the model of the level before; replaces GroupingOptions.
using GroupMaker =
    std::function<Groups(const MassSpringModel& fine, const Groups& of_base, std::uint32_t level)>;

struct SimplifyOptions {
  std::uint32_t levels = 2;
  /// Nodes of each level over those of the base, falling; met exactly. Empty: as many as the
  /// grouping makes; straight from the base, 0.45, 0.2, 0.09, ...
  std::vector<double> keep{};
  GroupingOptions grouping{};
  /// Every level merged straight from the base, as those of compact and metis always are: no level
  /// has to do with what the one before merged.
  bool straight = false;
  MassRule mass = MassRule::proportional;
  bool guards = true;
  GuardOptions guard{};  ///< its border rule is taken from `grouping`
  GroupMaker groups{};   ///< optional
  Calibrate calibrate = Calibrate::none;
  CalibrateOptions calibration{};  ///< for Calibrate::modes
  std::string made_by{};           ///< left empty: told from the options
  Progress* progress = nullptr;
};
constexpr auto option_rows(const SimplifyOptions*) {
  return std::tuple(
      option("levels", &SimplifyOptions::levels,
             "levels besides the base, each merged from the one before"),
      option("keep", &SimplifyOptions::keep,
             "nodes of each level over those of the base, falling, met exactly; as many levels as "
             "there are numbers")
          .by_default("as the grouping makes; straight from the base 0.45, 0.2, ..."),
      nested(&SimplifyOptions::grouping),
      option("straight", &SimplifyOptions::straight,
             "each level is merged straight from the base, whatever the one before merged")
          .by_default("false; true of groupings that always are"),
      option("mass", &SimplifyOptions::mass, "where the mass of a group goes"),
      option("guards", &SimplifyOptions::guards,
             "fuse nodes that would coincide or be floppy; false: the raw merge"),
      record_option("guard", &SimplifyOptions::guard, "Guard",
                    "when a node counts as coincident or floppy", "the limits of Guard"),
      option("calibrate", &SimplifyOptions::calibrate, "what is done to levels after merging"),
      record_option("calibration", &SimplifyOptions::calibration, "Calibration",
                    "what calibrate = \"modes\" aims at", "that of Calibration"));
}

}  // namespace springlod::lod
