#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/random.hpp"
#include "report/stats.hpp"

namespace springlod::report {

namespace {

// With fewer distances the 95 % quantile would be the maximum.
constexpr std::size_t kLeastPairs = 20;

using Sources = std::vector<std::vector<double>>;

void validate(const Sources& sources, const NoiseFloorOptions& options) {
  if (sources.empty()) throw InputError("noise floor: no samples of the base; give at least one");
  for (std::size_t i = 0; i < sources.size(); ++i)
    require_sample(sources[i], kLeastStarts, fmt::format("source {}", i + 1));
  if (!(options.part > 0 && options.part < 1))
    throw InputError(fmt::format(
        "noise floor: quantile is {}, must be between 0 and 1, such as 0.95", options.part));
  if (options.resamples < kFewestResamples || options.resamples > kMostResamples)
    throw InputError(fmt::format("noise floor: resamples is {}, must be {} to {}",
                                 options.resamples, kFewestResamples, kMostResamples));
}

std::size_t smallest_of(const Sources& sources) {
  std::size_t smallest = sources.front().size();
  for (const auto& source : sources) smallest = std::min(smallest, source.size());
  return smallest;
}

/// Moves `count` random values to the front (Fisher-Yates).
void shuffle_front(std::vector<double>& values, std::size_t count, RandomStream& chance) {
  for (std::size_t i = 0; i < count; ++i)
    std::swap(values[i], values[i + chance.below(static_cast<std::uint32_t>(values.size() - i))]);
}

std::vector<double> slice(const std::vector<double>& values, std::size_t from, std::size_t count) {
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(from);
  return {first, first + static_cast<std::ptrdiff_t>(count)};
}

std::vector<double> drawn_with_replacement(const std::vector<double>& values, std::size_t count,
                                           RandomStream& chance) {
  std::vector<double> drawn(count);
  for (double& value : drawn)
    value = values[chance.below(static_cast<std::uint32_t>(values.size()))];
  return drawn;
}

class Drawing {
 public:
  Drawing(const Sources& sources, NoiseFloor& floor, const NoiseFloorOptions& options)
      : sources_(sources), floor_(floor), options_(options) {
    for (std::size_t i = 0; i < sources.size(); ++i)
      for (std::size_t j = i; j < sources.size(); ++j)
        if (i != j || sources[i].size() >= both_sides()) pairs_.emplace_back(i, j);
    floor_.with_replacement = pairs_.empty();
    if (sources.size() > 1 && smallest_of(sources) < std::max(floor.base_size, floor.other_size))
      throw InputError(fmt::format(
          "noise floor: the smallest source has {} values, but {} are drawn from each; run more "
          "starts of the base, or set a smaller size",
          smallest_of(sources), std::max(floor.base_size, floor.other_size)));
  }

  void run() {
    all_whole() ? measure_pairs() : draw_pairs();
    std::sort(floor_.distances.begin(), floor_.distances.end());
    floor_.level = sorted_quantile(floor_.distances, floor_.part);
  }

 private:
  std::size_t both_sides() const {
    return std::size_t{floor_.base_size} + std::size_t{floor_.other_size};
  }

  bool all_whole() const {
    return sources_.size() > 1 && std::all_of(sources_.begin(), sources_.end(), [&](auto& source) {
             return source.size() == floor_.base_size && source.size() == floor_.other_size;
           });
  }

  void measure_pairs() {
    if (pairs_.size() < kLeastPairs)
      throw InputError(
          fmt::format("noise floor: {} sources form {} pairs, but a quantile needs at least {}; "
                      "give at least 7 "
                      "sources, or larger ones",
                      sources_.size(), pairs_.size(), kLeastPairs));
    for (const auto& [i, j] : pairs_)
      floor_.distances.push_back(distance_between(sources_[i], sources_[j], floor_.distance));
  }

  void draw_pairs() {
    Task task(options_.progress, "noise floor", options_.resamples);
    for (std::uint32_t r = 0; r < options_.resamples; ++r) {
      floor_.distances.push_back(draw(r));
      task.advance();
    }
  }

  /// Every draw has its own random stream.
  double draw(std::uint32_t number) const {
    RandomStream chance(options_.seed, number);
    const auto measured = [&](const std::vector<double>& base, const std::vector<double>& other) {
      return distance_between(base, other, floor_.distance);
    };
    if (pairs_.empty()) {
      const auto base = drawn_with_replacement(sources_[0], floor_.base_size, chance);
      return measured(base, drawn_with_replacement(sources_[0], floor_.other_size, chance));
    }
    auto [i, j] = pairs_[number % pairs_.size()];
    std::vector<double> first = sources_[i];
    if (i == j) {
      shuffle_front(first, both_sides(), chance);
      return measured(slice(first, 0, floor_.base_size),
                      slice(first, floor_.base_size, floor_.other_size));
    }
    std::vector<double> second = sources_[j];
    if (chance.below(2) == 1) std::swap(first, second);  // random order
    shuffle_front(first, floor_.base_size, chance);
    shuffle_front(second, floor_.other_size, chance);
    return measured(slice(first, 0, floor_.base_size), slice(second, 0, floor_.other_size));
  }

  const Sources& sources_;
  NoiseFloor& floor_;
  const NoiseFloorOptions& options_;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;
};

}  // namespace

double distance_between(const std::vector<double>& base, const std::vector<double>& other,
                        SampleDistance distance) {
  return distance == SampleDistance::wasserstein ? wasserstein_distance(base, other)
                                                 : energy_distance(base, other);
}

NoiseFloor noise_floor(const Sources& sources, const NoiseFloorOptions& options) {
  validate(sources, options);
  const std::size_t usual = sources.size() == 1 ? sources[0].size() / 2 : smallest_of(sources);
  NoiseFloor floor;
  floor.base_size = options.base_size > 0 ? options.base_size : static_cast<std::uint32_t>(usual);
  floor.other_size = options.other_size > 0 ? options.other_size : floor.base_size;
  floor.distance = options.distance;
  floor.part = options.part;
  Drawing(sources, floor, options).run();
  return floor;
}

FloorVerdict inside_noise_floor(const NoiseFloor& floor, const std::vector<double>& base,
                                const std::vector<double>& other) {
  if (base.size() != floor.base_size || other.size() != floor.other_size)
    throw InputError(fmt::format(
        "noise floor: it holds for sample sizes {} and {}, but the samples have {} and {} values; "
        "compute a floor for these sizes",
        floor.base_size, floor.other_size, base.size(), other.size()));
  FloorVerdict verdict;
  verdict.distance = distance_between(base, other, floor.distance);
  verdict.inside = verdict.distance <= floor.level;
  const auto as_far =
      floor.distances.end() -
      std::lower_bound(floor.distances.begin(), floor.distances.end(), verdict.distance);
  verdict.p = static_cast<double>(as_far + 1) / static_cast<double>(floor.distances.size() + 1);
  return verdict;
}

}  // namespace springlod::report
