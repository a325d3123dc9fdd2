#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.hpp"
#include "model/chain.hpp"

namespace springlod {

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

/// Measures every level beside the base and keeps with it what was found. Loads act on the base's
/// nodes and are summed over the groups. Misses of the tolerance are those of fit_part: the other
/// modes may be off by four times as much, smooth loads by eight times, held-out ones by twelve;
/// mechanisms, and masses that moved, never.
/// The same for any number of threads. Throws InputError where elastic_body does, and if
/// no node of `within` lies on the surface.
void certify(LodChain& chain, const CertifyOptions& options = {});

}  // namespace springlod
