#pragma once

#include <cstdint>

#include "sim/integrators/stepper.hpp"
#include "sim/run.hpp"

namespace springlod::sim {

/// Records the requested data at the frame times.
class Recorder {
 public:
  /// `frame_rate`: frames per second; 0: only the first and the last.
  Recorder(double frame_rate, bool ledger, Trajectory& trajectory)
      : rate_(frame_rate), ledger_(ledger), trajectory_(&trajectory) {}

  /// All frames that fall into the step that `body` is about to take.
  void record(const Stepper& body);
  /// Number of steps until the next frame falls into the following step; at least 1.
  std::uint64_t steps_to_next(const Stepper& body) const;
  /// Records all frames until `time` of a body that no longer moves.
  void record_rest(const Stepper& body, double time);
  /// Records the last state, at `time`, unless it is already a frame.
  void record_end(const Stepper& body, double time);

 private:
  double next_time() const;
  void keep(double time, const Stepper& body, double position_time);

  /// The loads of the anchors since the last frame.
  void keep_anchors(const Stepper& body);

  double rate_;
  bool ledger_;
  Trajectory* trajectory_;
  std::uint64_t count_ = 0;
  std::vector<AnchorSum> sums_;  // at the last frame
  double sums_time_ = 0;         // [s]
};

}  // namespace springlod::sim
