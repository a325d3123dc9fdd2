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
  std::uint32_t held_out_loads = 40;       ///< number of pinches, and of pushes
  std::uint64_t seed = 1;                  ///< of the patches they act on
  double radius = 3;                       ///< of the patches, see elastic::LocalLoadOptions
  std::vector<std::uint32_t> within = {};  ///< base nodes they act on; empty: the whole surface
  Support anchored = {};                   ///< of the base
  /// Largest accepted mean error of the ten lowest frequencies [1]; 0: no bound.
  double tolerance = 0;
  std::uint32_t threads = 1;     ///< 0: all cores
  Progress* progress = nullptr;  ///< may be null
};
constexpr auto option_rows(const CertifyOptions*) {
  return std::tuple(
      option("modes", &CertifyOptions::modes, "number of lowest frequencies to compare")
          .within(1, 1000),
      option("held_out_loads", &CertifyOptions::held_out_loads,
             "number of pinches, and of pushes, on patches of the surface, which are others than "
             "those of a calibration")
          .within(0, 10000),
      option("seed", &CertifyOptions::seed, "seed of the positions of the held-out loads"),
      option("radius", &CertifyOptions::radius,
             "radius of the patches of the held-out loads, in mean spring lengths of the base")
          .within(0, 1000),
      nodes_option("within", &CertifyOptions::within,
                   "nodes of the base whose surface the held-out loads act on, such as a region "
                   "given to calibration",
                   "anywhere"),
      option("tolerance", &CertifyOptions::tolerance,
             "largest accepted mean error of the ten lowest frequencies; the certificate names "
             "levels that exceed it")
          .within(0, 10)
          .by_default("none"),
      anchored_option(&CertifyOptions::anchored));
}

/// Measures every level and the base alike and stores the errors as the level's certificate
/// (docs/method.md, eqs. 48 to 50b). Loads act on base nodes and are summed over the groups. Only
/// what the caller asks for can be outside tolerance; quality/grade.hpp tells the errors in words.
/// Results are bit-identical for any number of threads. Throws InputError where elastic_body does,
/// and if no node of `within` is a border node.
void certify(LodChain& chain, const CertifyOptions& options = {});

}  // namespace springlod::lod
