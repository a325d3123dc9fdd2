#include "report/playback.hpp"

#include <algorithm>
#include <cstddef>

namespace springlod::report {

std::vector<Vec3> positions_at(const std::vector<sim::Frame>& frames, double t) {
  const auto after =
      std::upper_bound(frames.begin(), frames.end(), t,
                       [](double time, const sim::Frame& f) { return time < f.time; });
  if (after == frames.begin()) return frames.front().x;
  if (after == frames.end()) return frames.back().x;
  const sim::Frame& a = *(after - 1);
  const sim::Frame& b = *after;
  const double share = (t - a.time) / (b.time - a.time);
  std::vector<Vec3> x(a.x.size());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = a.x[i] + share * (b.x[i] - a.x[i]);
  return x;
}

std::vector<Vec3> smoothed(const std::vector<Vec3>& path, std::uint32_t reach) {
  std::vector<Vec3> out;
  out.reserve(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    // A symmetric window: an asymmetric one would pull the ends inwards.
    const std::size_t r = std::min({std::size_t{reach}, i, path.size() - 1 - i});
    Vec3 sum = Vec3::Zero();
    for (std::size_t j = i - r; j <= i + r; ++j) sum += path[j];
    out.emplace_back(sum / static_cast<double>(2 * r + 1));
  }
  return out;
}

}  // namespace springlod::report
