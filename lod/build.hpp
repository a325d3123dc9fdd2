#pragma once

#include <cstdint>
#include <functional>

#include "lod/grouping.hpp"
#include "lod/guard.hpp"
#include "lod/merge.hpp"
#include "model/chain.hpp"
#include "model/progress.hpp"

namespace springlod {

/// Makes the groups of one level from the model of the level before; replaces GroupingOptions.
using GroupMaker =
    std::function<Groups(const MassSpringModel& fine, const Groups& of_base, std::uint32_t level)>;

struct SimplifyOptions {
  std::uint32_t levels = 2;
  GroupingOptions grouping{};
  MassRule mass = MassRule::proportional;
  bool guards = true;
  GuardOptions guard{};   ///< its border rule is taken from `grouping`
  GroupMaker groups{};    ///< optional
  std::string made_by{};  ///< left empty: told from the options
  Progress* progress = nullptr;
};

/// Level 0 = `base`, level n merged from level n-1. Throws InputError if a level cannot get any
/// coarser (says which and why).
LodChain simplify(MassSpringModel base, const SimplifyOptions& options);

}  // namespace springlod
