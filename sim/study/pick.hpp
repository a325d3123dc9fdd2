#pragma once

#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

#include "base/option.hpp"
#include "base/progress.hpp"
#include "model/chain.hpp"
#include "sim/run.hpp"
#include "sim/scenario.hpp"
#include "sim/study/no_contact.hpp"

namespace springlod::sim {

struct PickOptions {
  /// Largest surface error, as a fraction of the base's bounding diagonal [1], 0 < error < 1.
  std::optional<double> error = std::nullopt;
  /// Largest processor time for a frame [s] > 0. Either this or `error`.
  std::optional<double> budget = std::nullopt;
  /// Run the base and every level, instead of a prediction from the certificates.
  bool measure = false;
  /// Errors are averaged from t = 0 to this long after the first contact [s].
  double error_window = 0.25;
  std::uint32_t threads = 0;  ///< runs are spread over threads; 0: all cores. Never changes errors
  /// For all levels; costs are those of frames at `frame_rate`.
  RunOptions run = {.ledger = false};
  std::optional<ContactAt> contact = {};  ///< empty: that of the chain
  Progress* progress = nullptr;
};
constexpr auto option_rows(const PickOptions*) {
  return std::tuple(
      option("error", &PickOptions::error,
             "largest surface error that the level may have, as a fraction of the base's bounding "
             "diagonal: 0.02 or \"2 %\"")
          .within(1e-9, 100)
          .by_default("none; give this or budget"),
      option("budget", &PickOptions::budget, "largest processor time for a frame")
          .within(1e-9, 1000)
          .in(Dimension::time)
          .by_default("none; give this or error"),
      option("measure", &PickOptions::measure,
             "run the base and all levels and measure errors and costs, instead of a prediction "
             "from the certificates and runs of the coarsest level"),
      option("error_window", &PickOptions::error_window,
             "time after the first contact up to which errors are averaged, as in compare")
          .within(0, 1e6)
          .in(Dimension::time),
      option("threads", &PickOptions::threads, kThreadsHelp).within(0, 1024),
      nested(&PickOptions::run));
}

/// One level of a chain in one scene.
struct PickLevel {
  std::uint32_t level = 0;
  std::uint32_t nodes = 0, springs = 0;
  /// Surface error (docs/method.md, eq. 72), over the base's bounding diagonal [1]; 0 for the base.
  double error = 0;
  double cost = 0;      ///< processor time for a frame [s]; measured on this machine
  bool within = false;  ///< within the requested error or budget, and not faulty
  /// Its certificate has more mechanisms than the base, or another mass: never picked.
  bool faulty = false;
};

struct Pick {
  PickOptions options;
  std::vector<PickLevel> levels;             ///< one for each level of the chain, the base first
  std::optional<std::uint32_t> level;        ///< the picked one; none: all levels exceed the budget
  std::optional<NoContact> no_contact = {};  ///< of the run that errors come from
};

/// Throws InputError for a chain of one level, and for options out of range.
void validate(const LodChain& chain, const PickOptions& options);

/// The coarsest level whose error is at most `error`, or the level of the smallest error whose cost
/// is at most `budget`. The base has the error 0, so it is picked if no other level is accurate
/// enough. A faulty level is never picked. Errors and the pick by `error` are the same for any
/// number of threads.
///
/// Without `measure`, the errors are predicted (predict_errors); this needs a certificate for each
/// level with springs. Throws InputError where `validate` does and for a level without a
/// certificate; the errors of `run` for a run that failed.
Pick pick_level(const LodChain& chain, const Scenario& scenario, const PickOptions& options);

/// The choice from errors and costs alone: sets `within` of each level and returns the picked one.
std::optional<std::uint32_t> choose_level(std::vector<PickLevel>& levels,
                                          const PickOptions& options);

}  // namespace springlod::sim
