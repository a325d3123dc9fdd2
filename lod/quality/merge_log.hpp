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

/// One response of a level: a frequency or a compliance. Changes of a response are differences of
/// its natural logarithm.
struct Answer {
  enum class Kind {
    mode,    ///< frequency of one of the level's lowest modes
    smooth,  ///< compliance to one of the nine smooth loads
    local,   ///< compliance to a pinch or push of patches of the surface
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

/// One merge and its contributions to the changes of a step.
struct Merge {
  std::uint32_t node = 0;      ///< merged node, of the level
  std::uint32_t pieces = 0;    ///< number of nodes merged into it; 1: not merged in this step
  std::vector<double> change;  ///< contribution to the change of each response [1]
  /// Cost: contribution to the mean |error| of the responses of a kind [1]. Below 0: the merge
  /// reduced the error.
  double frequencies = 0, smooth_loads = 0, local_loads = 0;
};

/// The merges from one level to a coarser one.
struct MergeStep {
  std::uint32_t from = 0, level = 0;  ///< numbers of the finer and the coarser level
  std::vector<Answer> answers;
  std::vector<double> change;  ///< of each response; sum of those of the merges [1]
  std::vector<double> error;   ///< change of each response from the base to the level [1]
  std::vector<Merge> merges;   ///< one for each node of the level
};

struct MergeLog {
  std::vector<MergeStep> steps;
};

struct MergeLogOptions {
  std::uint32_t modes = 10;
  std::uint32_t local_loads = 20;  ///< number of pinches, and of pushes
  std::uint64_t seed = 1;          ///< of the patches they act on, as in CertifyOptions
  /// Every step starts from the base, even if the level was merged from the one before.
  bool from_base = false;
  Support anchored = {};         ///< of the base
  std::uint32_t threads = 1;     ///< 0: all cores
  Progress* progress = nullptr;  ///< may be null
};
constexpr auto option_rows(const MergeLogOptions*) {
  using Options = MergeLogOptions;
  return std::tuple(
      option("modes", &Options::modes, "number of lowest modes of each level; 0: none")
          .within(0, 1000),
      option("local_loads", &Options::local_loads,
             "number of pinches, and of pushes, on patches of the surface; 0: none")
          .within(0, 10000),
      option("seed", &Options::seed, "seed of the positions of the local loads, as in certify"),
      option("from_base", &Options::from_base,
             "compare each level with the base, even if it was merged from the previous level"),
      anchored_option(&Options::anchored));
}

/// Attributes the errors of each level to its merges (docs/method.md, eqs. 51 to 53). There is one
/// step for each level, from the level before if it was merged from that one, otherwise (compact,
/// metis, refilled) from the base. The changes of a step are measured; the changes of its merges
/// add up to them (compliance_changes).
///
/// The modes are those of the level, so motions that the base does not have are included. Each is
/// interpolated to the other models as a shape w; its squared frequency there is, up to a common
/// factor, Schwarz's quotient w.f / u.f, with the inertia forces f of w and the displacements u
/// that f causes. The quotient is accurate to second order in the shape, and no modes need to be
/// matched.
///
/// Costs a factorization and the lowest modes of each level and static solutions of it and the
/// base. Results are bit-identical for any number of threads. Throws InputError for a chain without
/// a coarser level and where elastic_body does.
MergeLog log_merges(const LodChain& chain, const MergeLogOptions& options = {});

/// Mean |error| of the responses of a kind at the step's level [1]; 0 if there are none.
double mean_error(const MergeStep& step, Answer::Kind kind);

}  // namespace springlod::lod
