#pragma once

#include <cstdint>
#include <vector>

#include "model/vec.hpp"
#include "sim/fast/look/corner_look.hpp"
#include "sim/fast/rigid_motion.hpp"

namespace springlod::sim {

/// The vectorized functions of a layout for this processor. Each works on one block; FastBody
/// documents them.
template <class Layout, class State>
struct FastKernels {
  void (*find_forces)(const Layout&, std::uint32_t block, State&) = nullptr;
  void (*collect_forces)(const Layout&, std::uint32_t block, State&) = nullptr;
  double (*damping_power)(const Layout&, std::uint32_t block, const State&) = nullptr;
  void (*move)(const Layout&, std::uint32_t block, double kick, double drift, State&) = nullptr;
  Vec3 (*departure)(const Layout&, std::uint32_t block, double drift, const RigidMotion&,
                    const State&) = nullptr;
  // These may refresh what a block stores of other blocks' nodes.
  double (*find_corners)(const Layout&, std::uint32_t block, const CornerLook&, State&,
                         std::vector<std::uint32_t>& found) = nullptr;
  double (*largest_strain)(const Layout&, std::uint32_t block, State&) = nullptr;
};

}  // namespace springlod::sim
