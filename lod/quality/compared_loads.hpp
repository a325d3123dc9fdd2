#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "elastic/loads.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

struct ComparedLoadOptions {
  std::uint32_t count = 40;  ///< number of pinches, and of pushes
  std::uint64_t seed = 1;    ///< of the patches they act on
  double radius = 3;         ///< of the patches, see LocalLoadOptions
  /// Nodes that local loads act on, see LocalLoadOptions; empty: the whole surface.
  std::vector<std::uint32_t> within = {};
};

/// Static loads on the base nodes for comparing a level with its base: first the nine smooth loads,
/// which a calibration fits, then local loads on other patches than those that a calibration fits,
/// whatever the seeds.
struct ComparedLoads {
  std::vector<elastic::StaticLoad> all;
  std::size_t smooth = 0;  ///< number of smooth loads

  bool held_out(std::size_t load) const { return load >= smooth; }
};

/// The loads for `base`; smooth loads alone if it has no border nodes. Throws InputError if
/// `within` is not empty and none of its nodes is a border node.
ComparedLoads compared_loads(const MassSpringModel& base, const ComparedLoadOptions& options);

}  // namespace springlod::lod
