#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"

// What can be asked of simplify, step by step: groups, merging, guards, calibration.
namespace springlod::lod {

/// What draws two or three nodes together (the paper, section 5).
enum class Grouping {
  standard,       ///< nearest neighbours first, nodes in random order (5.1)
  priority_soft,  ///< key L (1 + 4 g L): low gradient and short springs first
  priority_hard,  ///< gradient first, distance second: the paper's words (5.2)
  compact,        ///< round groups straight from the base, see compact_groups
  metis,          ///< graph partitions straight from the base, see metis_groups
};

/// What may happen to border nodes (5.3).
enum class BorderRule {
  none,
  /// Border nodes merge only with border nodes; a node whose best candidate is of the other kind
  /// skips its own turn, yet others may pick it.
  weak,
  strong,  ///< border nodes never merge
};

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

std::string to_string(Grouping grouping);
std::string to_string(BorderRule border);

/// Where the mass of a body goes when its nodes merge (the paper, section 4.2 and figure 2).
enum class MassRule {
  proportional,  ///< a node has the masses of its group
  /// Each piece of the body goes to the nearest node, so masses also shift to neighbours that did
  /// not merge.
  proximity,
};

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

/// Whose moments are kept while masses shift between nodes.
enum class KeptMoments {
  body,   ///< those of the whole
  pieces  ///< also those of each piece: connected nodes of one material, 20 or more
};

/// Part of a body that a level shall give way in as the base does, such as where it will touch the
/// ground or next to where it is held.
struct TargetRegion {
  std::vector<std::uint32_t> nodes;  ///< of the base; those on the border count
  double weight = 1;                 ///< of each load, where a smooth one has 1
  std::uint32_t patches = 40;        ///< loads on patches within it
};

struct TargetOptions {
  std::uint32_t modes = 20;
  bool smooth_loads = true;   ///< the nine of smooth_loads, and piece_loads
  double piece_weight = 0.3;  ///< of each of the latter, where one of the nine has 1
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

/// What is done to levels after merging.
enum class Calibration {
  none,    ///< as they were merged (the paper)
  moduli,  ///< see rescale_moduli
  modes,   ///< see calibrate
};

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
  Calibration calibration = Calibration::none;
  CalibrateOptions calibrate{};  ///< for Calibration::modes
  std::string made_by{};         ///< left empty: told from the options
  Progress* progress = nullptr;
};

}  // namespace springlod::lod
