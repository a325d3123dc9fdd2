#include "sim/run/recorder.hpp"

#include <cmath>
#include <limits>

namespace springlod::sim {

double Recorder::next_time() const {
  if (count_ == 0) return 0;
  return rate_ > 0 ? static_cast<double>(count_) / rate_ : std::numeric_limits<double>::infinity();
}

void Recorder::record(const Stepper& body) {
  while (next_time() < body.time() + body.step()) {
    keep(next_time(), body, next_time());
    ++count_;
  }
}

std::uint64_t Recorder::steps_to_next(const Stepper& body) const {
  constexpr double kMany = 1e9;  // more than any run takes at once
  const double steps = std::floor((next_time() - body.time()) / body.step());
  if (!(steps > 1)) return 1;
  return static_cast<std::uint64_t>(std::min(steps, kMany));
}

void Recorder::record_rest(const Stepper& body, double time) {
  while (next_time() < time) {
    keep(next_time(), body, body.time());
    ++count_;
  }
}

void Recorder::record_end(const Stepper& body, double time) {
  // Steps and frame times are rounded differently: times this close count as the same instant.
  const double same = 1e-6 * body.step();
  auto& frames = trajectory_->frames;
  if (!frames.empty() && frames.back().time > time - same) {
    frames.pop_back();
    if (ledger_) trajectory_->ledger.pop_back();
  }
  keep(time, body, body.time());
}

void Recorder::keep_anchors(const Stepper& body) {
  const std::vector<AnchorSum>& now = body.anchor_sums();
  auto& frames = trajectory_->anchor_loads;
  if (now.empty() || frames.size() == trajectory_->frames.size()) return;  // the last was replaced
  const double interval = body.time() - sums_time_;
  if (frames.empty()) {
    frames.emplace_back(now.size());
    sums_.resize(now.size());
  } else {
    frames.push_back(frames.back());
  }
  if (!(interval > 0)) return;  // within one step
  for (std::size_t a = 0; a < now.size(); ++a)
    frames.back()[a] = {.force = (now[a].impulse - sums_[a].impulse) / interval,
                        .torque = (now[a].twist - sums_[a].twist) / interval,
                        .work = now[a].work};
  sums_ = now;
  sums_time_ = body.time();
}

void Recorder::keep(double time, const Stepper& body, double position_time) {
  trajectory_->frames.push_back({time, body.positions_at(position_time)});
  keep_anchors(body);
  if (!ledger_) return;
  trajectory_->ledger.push_back(body.ledger_entry());
  if (position_time != time) trajectory_->ledger.back().time = time;
}

}  // namespace springlod::sim
