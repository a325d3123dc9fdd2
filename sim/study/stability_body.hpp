#pragma once

#include <array>
#include <memory>
#include <vector>

#include "model/chain.hpp"
#include "sim/run.hpp"
#include "sim/study/probe.hpp"
#include "sim/study/stability_map.hpp"

namespace springlod::sim {

/// The chain at one ratio, and how its base swings.
struct RescaledChain {
  LodChain chain;
  std::vector<double> frequencies;  ///< of the base, lowest first [rad/s]
  double period = 0;                ///< of the slowest mode [s]
  ProbeMotion motion;
};
/// Throws InputError if the base has no mode that springs resist.
RescaledChain rescaled_chain(const LodChain& chain, double ratio, const StabilityOptions& options);

/// A level at one ratio, ready to be probed: the reference that its runs are compared with.
struct Specimen {
  std::shared_ptr<const RescaledChain> at_ratio;
  State start;
  Scenario scene;  ///< neither gravity nor obstacles
  std::vector<Frame> reference;
  double reference_way = 0;  ///< RMS way of its nodes from the start [m]
  /// Error of frames against the reference: see StabilityPoint::error.
  double error(const MassSpringModel& model, const std::vector<Frame>& frames) const;
};

/// Times at which runs are compared, the last of them the end.
inline constexpr int kSamples = 20;

/// Makes the reference and fills in the rest of `body`, whose level and ratio are set. The
/// reference is two runs, each with a progress of its own.
Specimen make_specimen(const std::shared_ptr<const RescaledChain>& at_ratio,
                       const StabilityOptions& options, std::array<Progress*, 2> progress,
                       StabilityBody& body);

/// Nodes that springs leave loose, worst first, over all parts; empty for a sound model.
std::vector<std::uint32_t> loose_nodes(const MassSpringModel& model);

}  // namespace springlod::sim
