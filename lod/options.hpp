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

// Options of simplify: grouping, merging, guards, calibration.
namespace springlod::lod {

struct GroupingTask;

/// Rule that selects the nodes to merge. Each is described in its row, see choices(Grouping).
enum class Grouping { standard, priority_soft, priority_hard, compact, metis };

/// A row of the table of groupings.
struct GroupingChoice : Choice<Grouping> {
  Groups (*make)(const GroupingTask& task);
  struct Traits {
    /// Makes a requested number of groups, so every level is merged straight from the base. The
    /// number of groups of the other groupings follows from the level before.
    bool from_base = false;
    bool follows_border = true;  ///< follows BorderRule
  } traits = {};
};
ChoiceTable<GroupingChoice> choices(Grouping);
/// Traits of a grouping that scripts can read.
constexpr auto choice_traits(const GroupingChoice& row) {
  return std::array{std::pair("from_base", row.traits.from_base),
                    std::pair("follows_border", row.traits.follows_border)};
}

/// Restriction on merging border nodes (the paper, section 5.3).
enum class BorderRule {
  none,
  /// Border nodes merge only with border nodes. A node whose best candidate is of the other kind
  /// skips its turn; other nodes may still choose it.
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

/// Nodes are visited in ascending order of the result. Called once for each node.
using NodePriority = std::function<double(std::uint32_t node)>;
/// A node takes the neighbour of lowest result; NaN or infinity forbids the pair. Called once for
/// each spring, with a < b.
using PairCost = std::function<double(std::uint32_t a, std::uint32_t b)>;

struct GroupingOptions {
  Grouping grouping = Grouping::standard;
  BorderRule border = BorderRule::none;
  std::uint64_t seed = 1;
  double grading = 0.5;          ///< of compact groups by stiffness, 0 to 1, see graded_shares
  NodePriority node_priority{};  ///< replaces the order in which nodes are visited
  PairCost pair_cost{};          ///< replaces the key by which neighbours are chosen
};
constexpr auto option_rows(const GroupingOptions*) {
  return std::tuple(
      option("grouping", &GroupingOptions::grouping, "rule that selects the nodes that merge"),
      option("border", &GroupingOptions::border, "treatment of border nodes"),
      option("seed", &GroupingOptions::seed,
             "seed of the random order; the same seed gives the same bits"),
      option("grading", &GroupingOptions::grading,
             "grading of compact: with larger values, groups are larger in stiff materials "
             "than in soft ones, and the stable step is longer")
          .within(0, 1));
}

/// Distribution of mass to merged nodes (the paper, section 4.2 and figure 2).
enum class MassRule {
  proportional,  ///< a node has the mass of its group
  /// Each piece of the body goes to the nearest node, so mass also shifts to neighbours that were
  /// not merged.
  proximity,
};

inline constexpr Choice<MassRule> kMassRules[] = {
    {MassRule::proportional, "proportional", "a node has the mass of its group"},
    {MassRule::proximity, "proximity",
     "each eighth of a base node's mass goes to the nearest node of the level"}};
constexpr ChoiceTable<Choice<MassRule>> choices(MassRule) {
  return {"mass", kMassRules};
}

struct GuardOptions {
  /// Joined groups are fused if their distance is below this fraction of the fine model's mean
  /// spring length (docs/method.md, eq. 20): coincident centroids would give an infinite k.
  double coincident_fraction = 0.25;
  /// A node with fewer springs is floppy and is fused with its nearest neighbour (eq. 21).
  std::uint32_t least_springs = 4;
  /// A node is also floppy if lambda_min / lambda_max of sum k u u^T is below this (eq. 21): its
  /// springs lie nearly in one plane.
  double least_rigidity = 1e-3;
  BorderRule border = BorderRule::none;  ///< strong: only inner nodes are fused
};
constexpr auto option_rows(const GuardOptions*) {
  return std::tuple(
      option("coincident_fraction", &GuardOptions::coincident_fraction,
             "fusion distance of joined nodes, as a fraction of the mean spring length")
          .within(0, 10),
      option("least_springs", &GuardOptions::least_springs,
             "number of springs below which a node is floppy")
          .within(0, 1000),
      option(
          "least_rigidity", &GuardOptions::least_rigidity,
          "a node is floppy if lambda_min / lambda_max of its springs' sum k u u^T is below this")
          .within(0, 1));
}

/// Masses of a level's nodes in a calibration.
enum class NodeMasses {
  group,  ///< each node keeps the mass of its group
  free    ///< fitted too; only the moments of mass are kept
};

inline constexpr Choice<NodeMasses> kNodeMasses[] = {
    {NodeMasses::group, "group",
     "each node keeps the mass of its group, so that impacts give the velocities of the base"},
    {NodeMasses::free, "free",
     "masses are fitted as stiffnesses are: lower errors of frequencies, larger ones after "
     "an impact"}};
constexpr ChoiceTable<Choice<NodeMasses>> choices(NodeMasses) {
  return {"masses", kNodeMasses};
}

/// Moments of mass that a calibration with NodeMasses::free keeps (docs/method.md, eqs. 35 and 36).
enum class KeptMoments {
  body,   ///< those of the whole body
  pieces  ///< those of each material region of 20 nodes or more, and of the smaller ones together
};

inline constexpr Choice<KeptMoments> kKeptMoments[] = {
    {KeptMoments::body, "body", "those of the whole body"},
    {KeptMoments::pieces, "pieces",
     "also those of each material region: more accurate in impacts, shorter stable time step"}};
constexpr ChoiceTable<Choice<KeptMoments>> choices(KeptMoments) {
  return {"moments", kKeptMoments};
}

/// A region of the surface whose local compliance a calibration fits, such as a contact face or the
/// surroundings of an anchor.
struct TargetRegion {
  std::vector<std::uint32_t> nodes;  ///< base nodes; loads act on the border nodes among them
  double weight = 1;                 ///< of each load, relative to a smooth load [1]
  std::uint32_t patches = 40;        ///< number of loads on patches within it
};
constexpr auto option_rows(const TargetRegion*) {
  return std::tuple(
      nodes_option("nodes", &TargetRegion::nodes,
                   "nodes of the base: their numbers, or a function of a Node that returns true "
                   "for them; only border nodes that are not anchored count"),
      option("weight", &TargetRegion::weight,
             "weight of each load of the region; a smooth load has 1")
          .within(0, 1e6)
          .weight(),
      option("patches", &TargetRegion::patches,
             "number of loads on patches within the region: half are pairs that are pulled apart, "
             "if there is room; the others are pushes, which the body's inertia balances")
          .within(0, 10000));
}

/// Kinds of targets of a calibration.
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
  /// The loads are smooth_loads, piece_loads, and loads on patches and regions.
  TargetKinds kinds = TargetKinds::both;
  std::uint32_t modes = 20;
  double piece_weight = 0.3;  ///< of each of piece_loads, relative to a smooth load [1]
  /// Number of loads on patches of the surface; empty: see patch_count. Without them a fit
  /// increases the error of loads that are not fitted.
  std::optional<std::uint32_t> patches = {};
  double patch_weight = 0.3;  ///< of each of these, relative to a smooth load [1]
  std::vector<TargetRegion> regions = {};
  /// Factors on the weights of all frequencies, of the mode shapes and of all static loads [1].
  double mode_weight = 1, shape_weight = 1, load_weight = 1;
  std::uint64_t seed = 1;  ///< of the patches
  Support anchored = {};   ///< of the base
  // calibrate() sets these two to its own.
  std::uint32_t threads = 1;     ///< at most two are used; results do not depend on it
  Progress* progress = nullptr;  ///< may be null
};
constexpr auto option_rows(const TargetOptions*) {
  return std::tuple(
      option("targets", &TargetOptions::kinds, "quantities fitted to the base"),
      option("modes", &TargetOptions::modes, "number of lowest frequencies").within(0, 1000),
      option("patches", &TargetOptions::patches,
             "number of loads on surface patches, besides the nine smooth loads: a third each are "
             "pairs "
             "that are pulled apart, pinches, and pushes")
          .within(0, 10000)
          .by_default("150; fewer, down to 60, for a base of more than 2000 nodes"),
      option("patch_weight", &TargetOptions::patch_weight,
             "weight of each load on patches; a smooth load has 1")
          .within(0, 1e6)
          .weight(),
      record_option("regions", &TargetOptions::regions, "Region",
                    "regions of the surface with load cases of their own", "none"),
      option("mode_weight", &TargetOptions::mode_weight, "factor on the weight of frequencies")
          .within(0, 1e6)
          .weight(),
      option("shape_weight", &TargetOptions::shape_weight,
             "factor on the weight of mode shapes, which are fitted by the static displacements "
             "under the inertial forces of each mode; 0: shapes are not fitted")
          .within(0, 1e6)
          .weight(),
      option("load_weight", &TargetOptions::load_weight, "factor on the weight of all static loads")
          .within(0, 1e6)
          .weight(),
      option("seed", &TargetOptions::seed, "seed of the patches"),
      anchored_option(&TargetOptions::anchored));
}

struct FitOptions {
  /// Largest number of steps; 0: 90 for up to 500 nodes, down to 10 for large levels, see
  /// fit_steps.
  std::uint32_t iterations = 0;
  /// Tolerance t of the mean error of the ten lowest frequencies [1]; 0: see frequency_tolerance.
  /// The tolerance of the other modes is 3 t, of loads 8 t (docs/method.md, eq. 44).
  double tolerance = 0;
  /// The fit lowers omega_max to this fraction of omega0_max (N / N0)^(1/3), that of a lattice with
  /// as many nodes (docs/method.md, eq. 45) [1]. A lower omega_max increases the errors.
  double least_frequency = 0.87;
  /// With fixed masses, impacts are as accurate as the groups are, and mass cannot move to where it
  /// lengthens the step.
  NodeMasses masses = NodeMasses::group;
  /// Has an effect only if masses are free. With KeptMoments::pieces stiff regions cannot take mass
  /// from the others. More accurate in impacts; shorter stable time step.
  KeptMoments moments = KeptMoments::body;
  /// At most two are used; results do not depend on it. calibrate() sets it to its own.
  std::uint32_t threads = 1;
};
constexpr auto option_rows(const FitOptions*) {
  return std::tuple(
      option("tolerance", &FitOptions::tolerance,
             "tolerance of the mean error of the ten lowest frequencies; other modes have 3 times "
             "the tolerance, loads 8 times")
          .within(0, 10)
          .by_default("0.0033 sqrt(N0 / N)"),
      option("iterations", &FitOptions::iterations,
             "maximum number of steps; the default is smaller, down to 10, for levels of more than "
             "500 nodes")
          .within(0, 10000)
          .by_default("90"),
      option(
          "least_frequency", &FitOptions::least_frequency,
          "the fit lowers the highest frequency, which bounds the step, to this fraction of that "
          "of a lattice with as many nodes; lower: longer steps, larger errors")
          .within(0, 10),
      option("masses", &FitOptions::masses, "masses of the nodes"),
      option("moments", &FitOptions::moments,
             "with masses = \"free\": moments of mass (mass, centre, second moments) that stay "
             "unchanged while masses shift between nodes"));
}

/// Treatment of levels after merging.
enum class Calibrate {
  none,    ///< none, as in the paper
  moduli,  ///< see rescale_moduli
  modes,   ///< see calibrate
};

/// A row of the table of calibrations; `remark` is appended to Level::made_by.
struct CalibrateChoice : Choice<Calibrate> {
  const char* remark;
};
inline constexpr CalibrateChoice kCalibrate[] = {
    {{Calibrate::none, "none", "levels are only merged"}, ""},
    {{Calibrate::moduli, "moduli",
      "springs are scaled so that each material has the base's Young's modulus by eq. 2 of the "
      "paper"},
     ", moduli rescaled"},
    {{Calibrate::modes, "modes",
      "levels are fitted to the base's frequencies and compliances, with the longest stable step "
      "that these allow, and get a certificate"},
     ", calibrated"}};
constexpr ChoiceTable<CalibrateChoice> choices(Calibrate) {
  return {"calibrate", kCalibrate};
}

struct CalibrateOptions {
  TargetOptions targets{};
  FitOptions fit{};
  /// Folder for the state of the calibration (CalibrationStore). A stopped calibration resumes from
  /// it with bit-identical results when the call is repeated. Empty: no state is saved.
  std::filesystem::path store{};
  /// Time between two writes of a fit's state to the store [s], 0: after each step. A step of a
  /// large level takes seconds, its state is some megabytes. A fit that is interrupted or done
  /// writes its state in any case; one that is killed loses the steps since the last write.
  double keep_every = 2;
  /// Levels fitted at a time; 0: one for each core. With more than one, each may use a second
  /// thread, because the levels differ much in size.
  std::uint32_t threads = 1;
  Progress* progress = nullptr;  ///< may be null
};
constexpr auto option_rows(const CalibrateOptions*) {
  return std::tuple(
      nested(&CalibrateOptions::targets), nested(&CalibrateOptions::fit),
      option(
          "store", &CalibrateOptions::store,
          "folder for intermediate results: an interrupted call that is repeated resumes from them "
          "and ends with the same bits; results of another base, level or options are not used")
          .by_default("none"),
      option("keep_every", &CalibrateOptions::keep_every,
             "time between two writes of a fit's state to the store; 0: after each step. A killed "
             "calibration loses this much work at most, one stopped with Ctrl-C none")
          .within(0, 1e6)
          .in(Dimension::time));
}

/// Makes the groups of one level from the model of the level before; replaces GroupingOptions.
using GroupMaker =
    std::function<Groups(const MassSpringModel& fine, const Groups& of_base, std::uint32_t level)>;

struct SimplifyOptions {
  std::uint32_t levels = 2;
  /// Number of nodes of each level as a fraction of the base's, descending; met exactly. Empty: as
  /// many as the grouping makes; for levels merged straight from the base 0.45, 0.2, 0.09, ... or
  /// the nearest that the guards allow.
  std::vector<double> keep{};
  GroupingOptions grouping{};
  /// Every level is merged straight from the base, independently of the other levels. Groupings
  /// with the trait from_base do so always.
  bool straight = false;
  MassRule mass = MassRule::proportional;
  bool guards = true;
  GuardOptions guard{};                  ///< its border rule is taken from `grouping`
  GroupMaker groups{};                   ///< optional
  ContactAt contact = ContactAt::nodes;  ///< LodChain::contact
  Calibrate calibrate = Calibrate::none;
  CalibrateOptions calibration{};  ///< for Calibrate::modes
  std::string made_by{};           ///< Level::made_by; empty: a summary of the options
  Progress* progress = nullptr;
};
constexpr auto option_rows(const SimplifyOptions*) {
  return std::tuple(
      option("levels", &SimplifyOptions::levels,
             "number of levels besides the base; each is merged from the previous one")
          .within(0, 1000),
      option("keep", &SimplifyOptions::keep,
             "nodes of each level / nodes of the base, decreasing; the levels have exactly these "
             "numbers of nodes, one level per number")
          .within(0, 1)
          .by_default("set by the grouping; 0.45, 0.2, ... if straight"),
      nested(&SimplifyOptions::grouping),
      option("straight", &SimplifyOptions::straight,
             "merge each level directly from the base instead of from the previous level")
          .by_default("false; true for groupings that always do so"),
      option("mass", &SimplifyOptions::mass, "distribution of a group's mass"),
      option("guards", &SimplifyOptions::guards,
             "fuse nodes that would coincide or be floppy; false: the raw merge"),
      record_option("guard", &SimplifyOptions::guard, "Guard",
                    "limits at which nodes count as coincident or floppy", "those of Guard"),
      option("calibrate", &SimplifyOptions::calibrate, "calibration of the levels after merging"),
      record_option("calibration", &SimplifyOptions::calibration, "Calibration",
                    "targets of calibrate = \"modes\"", "those of Calibration"),
      option("contact", &SimplifyOptions::contact,
             "contact points of the levels in runs that do not set it; saved with the chain"));
}

}  // namespace springlod::lod
