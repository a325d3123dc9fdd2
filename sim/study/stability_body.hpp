#pragma once

#include <array>
#include <memory>
#include <vector>

#include "model/chain.hpp"
#include "sim/run.hpp"
#include "sim/study/probe.hpp"
#include "sim/study/stability_map.hpp"

namespace springlod::sim {

/// The chain at one ratio, and the natural frequencies of its base.
struct RescaledChain {
  LodChain chain;
  std::vector<double> frequencies;  ///< of the base, lowest first [rad/s]
  double period = 0;                ///< period of the slowest mode [s]
  ProbeMotion motion;
};
/// Throws InputError if all modes of the base are zero modes.
RescaledChain rescaled_chain(const LodChain& chain, double ratio, const StabilityOptions& options);

/// A level at one ratio, with the reference for its test runs.
struct Specimen {
  std::shared_ptr<const RescaledChain> at_ratio;  ///< whose level it is
  State start;
  Scenario scene;  ///< neither gravity nor obstacles
  std::vector<Anchor> anchors;
  std::vector<std::uint32_t> held;  ///< nodes that they hold, without those on springs
  std::vector<Frame> reference;
  double reference_displacement = 0;  ///< RMS displacement of its nodes from the start [m]
  /// Error of frames against the reference: see StabilityPoint::error.
  double error(const MassSpringModel& model, const std::vector<Frame>& frames) const;
};

/// Times at which runs are compared; the last one is the end of the run.
inline constexpr int kSamples = 20;

/// Computes the reference and fills in the other members of `body`, whose level and ratio are set.
/// The reference needs two runs, each with its own progress.
Specimen make_specimen(const std::shared_ptr<const RescaledChain>& at_ratio,
                       const StabilityOptions& options, std::array<Progress*, 2> progress,
                       StabilityBody& body);

/// Nodes that move in mechanisms, worst first, over all connected components; empty for a model
/// without mechanisms. `anchors`: of the base.
std::vector<std::uint32_t> loose_nodes(const Level& level, const std::vector<Anchor>& anchors);

}  // namespace springlod::sim
