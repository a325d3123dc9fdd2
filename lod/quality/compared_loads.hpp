#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "elastic/loads.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

struct ComparedLoadOptions {
  std::uint32_t count = 40;  ///< of each kind of local loads: pinches and pushes
  std::uint64_t seed = 1;    ///< of where they act
  /// Nodes that local loads act on, see LocalLoadOptions; empty: anywhere on the surface.
  std::vector<std::uint32_t> within = {};
};

/// Loads by which levels are told from their base, on the base's nodes: the nine smooth ones first,
/// which calibration is fitted to, then local ones on other patches than it is fitted to, whatever
/// the seeds.
struct ComparedLoads {
  std::vector<elastic::StaticLoad> all;
  std::size_t smooth = 0;  ///< how many of them, the first ones

  bool held_out(std::size_t load) const { return load >= smooth; }
};

/// Smooth ones alone of a model without border nodes. Throws InputError if nodes were chosen and
/// none of them is a border node.
ComparedLoads compared_loads(const MassSpringModel& base, const ComparedLoadOptions& options);

}  // namespace springlod::lod
