#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/choice.hpp"
#include "base/option.hpp"
#include "base/progress.hpp"
#include "model/anchors.hpp"
#include "model/chain.hpp"

namespace springlod::lod {

/// One way in which a level may be off its base. Changes are natural logarithms: of frequencies for
/// modes, of the compliance for loads.
struct Answer {
  enum class Kind {
    mode,    ///< to the inertia of one of the level's lowest modes
    smooth,  ///< to one of the nine smooth loads
    local,   ///< to a pinch or push of patches of the surface
  };
  std::string name;
  Kind kind = Kind::mode;
};

inline constexpr Choice<Answer::Kind> kAnswerKinds[] = {
    {Answer::Kind::mode, "mode", "frequency of one of the level's lowest modes"},
    {Answer::Kind::smooth, "smooth", "compliance to one of the nine smooth loads"},
    {Answer::Kind::local, "local", "compliance to a pinch or push of patches of the surface"}};
constexpr ChoiceTable<Choice<Answer::Kind>> choices(Answer::Kind) {
  return {"answer", kAnswerKinds};
}

/// What one merge changed.
struct Merge {
  std::uint32_t node = 0;      ///< of the level, that came of it
  std::uint32_t pieces = 0;    ///< nodes that became it; 1: not merged in this step
  std::vector<double> change;  ///< of each answer [1]
  /// How much farther it brought the level from its base (nearer: below 0): its part in the mean
  /// |error| of the answers of a kind [1].
  double frequencies = 0, smooth_loads = 0, local_loads = 0;
};

/// The merges that made one level.
struct MergeStep {
  std::uint32_t from = 0, level = 0;  ///< levels
  std::vector<Answer> answers;
  std::vector<double> change;  ///< of each answer: the sum of those of the merges [1]
  std::vector<double> error;   ///< of each answer, from the base to the level [1]
  std::vector<Merge> merges;   ///< for each node of the level
};

struct MergeLog {
  std::vector<MergeStep> steps;
};

struct MergeLogOptions {
  std::uint32_t modes = 10;
  std::uint32_t local_loads = 20;  ///< of each kind: pinches and pushes
  std::uint64_t seed = 1;          ///< of where they act, as in CertifyOptions
  /// Every step from the base, also where a level was merged from the one before.
  bool from_base = false;
  std::vector<std::uint32_t> anchored = {};  ///< nodes of the base that are held
  std::uint32_t threads = 1;                 ///< 0: all cores
  Progress* progress = nullptr;              ///< may be null
};
constexpr auto option_rows(const MergeLogOptions*) {
  using Options = MergeLogOptions;
  return std::tuple(
      option("modes", &Options::modes, "lowest modes of each level; 0: none"),
      option("local_loads", &Options::local_loads,
             "pinches, and as many pushes, on patches of the surface; 0: none"),
      option("seed", &Options::seed, "of where they act, as in certify"),
      option("from_base", &Options::from_base,
             "each step counts from the base, also where a level was merged from the one before"),
      anchored_option(&Options::anchored));
}

/// Which merge cost which error, level by level: the steps from each level to the next if it was
/// merged from that, else (compact, metis, refilled) from the base. A step's changes are measured,
/// those of its merges are their exact parts (compliance_changes).
///
/// Modes are those of the level, so that motions which the base has not are among them. Each is
/// carried to the other models as a shape w; its frequency there is Schwarz's quotient
/// w.f / u.f for the inertia forces f of w and the displacements u that they cause, which is right
/// to second order. No mode has to be matched with another.
///
/// Takes a factorisation and the lowest modes of each level, and static solves of it and the base.
/// The same for any number of threads. Throws InputError for a chain without a coarser level and
/// where elastic_body does.
MergeLog log_merges(const LodChain& chain, const MergeLogOptions& options = {});

/// Mean |error| of the answers of a kind at a step's level [1]; 0 if there are none.
double mean_error(const MergeStep& step, Answer::Kind kind);

}  // namespace springlod::lod
