#pragma once

#include <cstdint>
#include <vector>

#include "base/option.hpp"
#include "base/progress.hpp"
#include "model/anchors.hpp"
#include "model/chain.hpp"

namespace springlod::lod {

struct CertifyOptions {
  std::uint32_t modes = 20;
  std::uint32_t held_out_loads = 40;         ///< of each kind: pinches and pushes
  std::uint64_t seed = 1;                    ///< of where they act
  std::vector<std::uint32_t> within = {};    ///< nodes of the base they act on; empty: the surface
  std::vector<std::uint32_t> anchored = {};  ///< nodes of the base that are held
  /// Mean error of the ten lowest frequencies asked for [1], as in FitOptions.
  double tolerance = 0;
  std::uint32_t threads = 1;     ///< 0: all cores
  Progress* progress = nullptr;  ///< may be null
};
constexpr auto option_rows(const CertifyOptions*) {
  return std::tuple(
      option("modes", &CertifyOptions::modes, "lowest frequencies to compare"),
      option("held_out_loads", &CertifyOptions::held_out_loads,
             "pinches, and as many pushes, on patches of the surface; calibration is fitted to "
             "neither"),
      option("seed", &CertifyOptions::seed, "of where they act"),
      nodes_option("within", &CertifyOptions::within,
                   "nodes of the base whose surface the held-out loads act on, such as a region "
                   "that calibration was told of",
                   "anywhere"),
      option("tolerance", &CertifyOptions::tolerance,
             "mean error of the ten lowest frequencies that a level may have; a level that misses "
             "it says so")
          .by_default("0.002 sqrt(N0 / N)"),
      anchored_option(&CertifyOptions::anchored));
}

/// Measures every level beside the base and keeps with it what was found. Loads act on the base's
/// nodes and are summed over the groups. Misses of the tolerance are those of fit_part: the other
/// modes may be off by four times as much, smooth loads by eight times, held-out ones by twelve;
/// mechanisms, and masses that moved, never.
/// The same for any number of threads. Throws InputError where elastic_body does, and if
/// no node of `within` lies on the surface.
void certify(LodChain& chain, const CertifyOptions& options = {});

}  // namespace springlod::lod
