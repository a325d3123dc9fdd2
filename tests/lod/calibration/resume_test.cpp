// Calibrations that are stopped and resumed from their store.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "lod/build.hpp"
#include "lod/calibration/calibrate.hpp"
#include "lod/calibration/calibration_store.hpp"
#include "tests/support/assets.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace springlod;
using namespace springlod::lod;
using Catch::Matchers::Contains;
using springlod::test::block;
using springlod::test::TemporaryFolder;

namespace fs = std::filesystem;

namespace {

/// Represents a killed program: no state is saved when it is thrown.
struct Killed {};

/// Stops the calibration after `stop_after` advances and records what is reported.
class Watcher : public Progress {
 public:
  enum class End { interrupt, kill };

  explicit Watcher(std::uint64_t stop_after = std::numeric_limits<std::uint64_t>::max(),
                   End end = End::interrupt)
      : left_(stop_after), end_(end) {}

  void begin(std::string_view task, std::uint64_t /*total*/) override {
    const std::lock_guard lock(mutex_);
    tasks.emplace_back(task);
  }
  void advance(std::uint64_t count) override {
    const std::lock_guard lock(mutex_);
    if (tasks.empty() || tasks.back() != "calibrating" || count == 0) return;
    if (left_ == 0 && end_ == End::kill) throw Killed();
    if (left_ == 0) throw InterruptedError();
    --left_;
    ++steps;
    if (first_advance == 0) first_advance = count;
  }
  void detail(std::string_view text) override {
    const std::lock_guard lock(mutex_);
    last_detail = text;
  }
  void say(std::string_view text) override {
    const std::lock_guard lock(mutex_);
    said += std::string(text) + "\n";
  }

  std::vector<std::string> tasks;
  std::string said, last_detail;
  std::uint64_t steps = 0;
  std::uint64_t first_advance = 0;  // stored steps of the first level, if any

 private:
  std::mutex mutex_;
  std::uint64_t left_;
  End end_;
};

LodChain plain() {
  static const LodChain chain =
      simplify(block(4, 4, 6), {.keep = {0.5, 0.25}, .grouping = {.grouping = Grouping::compact}});
  return chain;
}

CalibrateOptions options_with(const fs::path& store, Progress* progress) {
  CalibrateOptions options{.store = store, .progress = progress};
  options.targets.patches = 10;
  options.fit.iterations = 14;
  return options;
}

LodChain calibrated(const CalibrateOptions& options) {
  LodChain chain = plain();
  calibrate(chain, options);
  return chain;
}

bool same_bits(const LodChain& one, const LodChain& two) {
  for (std::size_t level : {1, 2}) {
    const MassSpringModel &p = one.levels[level].model, &q = two.levels[level].model;
    if (p.mass != q.mass || p.stiffness != q.stiffness || p.damping != q.damping) return false;
  }
  return true;
}

void overwrite(const fs::path& path, std::size_t place, char byte) {
  std::string bytes = read_file(path);
  bytes.at(place) = byte;
  write_text_file(path, bytes);
}

const fs::path kNoStore;

}  // namespace

TEST_CASE("A calibration that is stopped repeatedly ends bit-identical to an uninterrupted one") {
  const NodeMasses masses = GENERATE(NodeMasses::group, NodeMasses::free);
  const auto options_of = [&](const fs::path& store, Progress* progress) {
    CalibrateOptions options = options_with(store, progress);
    options.fit.masses = masses;
    return options;
  };
  const LodChain whole = calibrated(options_of(kNoStore, nullptr));
  for (const std::uint64_t advances : {2, 5, 12}) {  // stored steps of a level are one advance
    const TemporaryFolder folder;
    std::optional<LodChain> found;
    int stops = 0;
    for (; !found && stops < 50; ++stops) {
      Watcher watcher(advances);
      try {
        found = calibrated(options_of(folder / "store", &watcher));
      } catch (const InterruptedError&) {
        CHECK_THAT(watcher.said, Contains("its state is saved in " + (folder / "store").string()));
      }
    }
    CHECK(stops > 2);
    REQUIRE(found);
    CHECK(same_bits(*found, whole));
  }
}

TEST_CASE("A calibration that is killed goes on from the last state that was due to be kept") {
  const LodChain whole = calibrated(options_with(kNoStore, nullptr));
  const TemporaryFolder folder;
  const fs::path fit = folder / "store/level-1-part-1.bin";
  const auto killed_after = [&](std::uint64_t steps, double keep_every) {
    Watcher watcher(steps, Watcher::End::kill);
    CalibrateOptions options = options_with(folder / "store", &watcher);
    options.keep_every = keep_every;
    CHECK_THROWS_AS(calibrated(options), Killed);
    return watcher.said;
  };
  constexpr double kNever = std::numeric_limits<double>::infinity();
  CHECK(killed_after(5, kNever).empty());
  CHECK_FALSE(fs::exists(fit));
  CHECK_THAT(killed_after(5, 0), Contains("its state is saved in " + (folder / "store").string()));
  CHECK(fs::exists(fit));

  Watcher watcher;
  CHECK(same_bits(calibrated(options_with(folder / "store", &watcher)), whole));
  CHECK(watcher.first_advance == 5);
  CHECK_THROWS_WITH(calibrated({.keep_every = -1}), Contains("keep_every = -1 must be 0 or more"));
}

TEST_CASE("A calibration may resume with another number of threads", "[threaded]") {
  const LodChain whole = calibrated(options_with(kNoStore, nullptr));
  const TemporaryFolder folder;
  Watcher watcher(6);
  CalibrateOptions options = options_with(folder / "store", &watcher);
  options.threads = 2;
  CHECK_THROWS_AS(calibrated(options), InterruptedError);
  options.progress = nullptr;
  CHECK(same_bits(calibrated(options), whole));
}

TEST_CASE("A resumed calibration repeats neither the measurements nor finished levels") {
  const TemporaryFolder folder;
  Watcher first(9);
  CHECK_THROWS_AS(calibrated(options_with(folder / "store", &first)), InterruptedError);
  CHECK(std::count(first.tasks.begin(), first.tasks.end(), "iterating for modes") == 1);
  CHECK_THAT(first.last_detail, Contains("level 1, step 10: f1..10 error"));

  Watcher second;
  const LodChain whole = calibrated(options_with(folder / "store", &second));
  CHECK_THAT(second.said, Contains("resumes from"));
  CHECK(std::count(second.tasks.begin(), second.tasks.end(), "iterating for modes") == 0);

  Watcher third;
  CHECK(same_bits(calibrated(options_with(folder / "store", &third)), whole));
  CHECK(third.steps == 2);  // one advance for each finished level
}

TEST_CASE("A store of another base, level or options, or a damaged one, is not used") {
  const TemporaryFolder folder;
  const fs::path store = folder / "store";
  calibrated(options_with(store, nullptr));

  Watcher watcher;
  CalibrateOptions other = options_with(store, &watcher);
  other.fit.tolerance = 0.02;
  const LodChain found = calibrated(other);
  CHECK_THAT(watcher.said,
             Contains("level-1-part-1.bin belongs to another base, another level or other "
                      "options and is ignored"));
  CHECK_THAT(watcher.said, !Contains("base-part-1.bin"));
  other.store.clear();
  CHECK(same_bits(found, calibrated(other)));

  Watcher seeded;
  other = options_with(store, &seeded);
  other.targets.seed = 2;
  calibrated(other);
  CHECK_THAT(seeded.said, Contains("base-part-1.bin belongs to another base"));

  const LodChain whole = calibrated(options_with(store, nullptr));
  overwrite(store / "level-2-part-1.bin", 100, 'x');
  write_text_file(store / "level-1-part-1.bin", "short");
  Watcher damaged;
  CHECK(same_bits(calibrated(options_with(store, &damaged)), whole));
  CHECK_THAT(damaged.said, Contains("level-2-part-1.bin is damaged"));
  CHECK_THAT(damaged.said, Contains("level-1-part-1.bin is damaged"));
}

TEST_CASE("A store that cannot be written is an error before any measurement") {
  const TemporaryFolder folder;
  write_text_file(folder / "file", "no folder");
  Watcher watcher;
  const CalibrateOptions options = options_with(folder / "file" / "store", &watcher);
  CHECK_THROWS_AS(calibrated(options), IoError);
  CHECK_THROWS_WITH(calibrated(options),
                    Contains("its state cannot be saved in") && Contains("use a writable folder"));
  CHECK(watcher.tasks.empty());
}

TEST_CASE("Measurements of a base are read back as they were stored") {
  const TemporaryFolder folder;
  const CalibrationStore store(folder / "store", nullptr);
  const BaseMeasurements measured{.squared_frequency = {1, 2},
                                  .modal_forces = {{{1, 2, 3}, {4, 5, 6}}, {{7, 8, 9}, {0, 1, 0}}},
                                  .compliance = {{3, 4, 5}, {6, 7, 8}},
                                  .highest_frequency = 6};
  store.keep(0, "fingerprint", measured);
  const std::optional<BaseMeasurements> back = store.measurements(0, "fingerprint");
  REQUIRE(back);
  CHECK(back->squared_frequency == measured.squared_frequency);
  CHECK(back->modal_forces == measured.modal_forces);
  CHECK(back->compliance == measured.compliance);
  CHECK(back->highest_frequency == 6);
}

TEST_CASE("A fit state is read back as it was stored") {
  const TemporaryFolder folder;
  const CalibrationStore store(folder / "store", nullptr);
  FitState state{.iteration = 7,
                 .bound = {.bound = 1.5,
                           .within = 1.8,
                           .merit = 0.3,
                           .steps = 4,
                           .idle = 1,
                           .refined = 2,
                           .took_back = true,
                           .slack = {1, 1.7, 1, 1.2, 1}},
                 .damping = 1e-3,
                 .increase = 8,
                 .now = {Eigen::VectorXd::LinSpaced(5, 0, 1), {1, 2, 3}},
                 .best = {},
                 .best_frequency = 12};
  for (const bool has_best : {false, true}) {
    if (has_best) state.best = FitPoint{Eigen::VectorXd::LinSpaced(5, 1, 2), {3, 2, 1}};
    store.keep(2, 0, "fingerprint", state);
    CHECK_FALSE(store.fit(2, 0, "another"));
    CHECK_FALSE(store.fit(1, 0, "fingerprint"));
    const std::optional<FitState> back = store.fit(2, 0, "fingerprint");
    REQUIRE(back);
    CHECK(back->iteration == 7);
    CHECK_FALSE(back->finished);
    CHECK(back->bound == state.bound);
    CHECK(back->damping == state.damping);
    CHECK(back->increase == state.increase);
    CHECK(back->best_frequency == 12);
    CHECK(back->now.theta == state.now.theta);
    CHECK(back->now.mass == state.now.mass);
    CHECK(back->best.has_value() == has_best);
    if (has_best) CHECK(back->best->theta == state.best->theta);
  }
}

TEST_CASE("Steps with non-finite residuals are rejected") {
  const MassSpringModel base = block(4, 4, 6);
  const Level level = plain().levels[2];
  ElasticTargets targets = measure_targets(base, level.of_base, {.modes = 10, .patches = 4});
  targets.loads.front().compliance = std::numeric_limits<double>::infinity();
  FitState last;
  FitProgress progress;
  progress.on_iteration = [&](const FitState& state) { last = state; };
  const MassSpringModel same = fit_part(level.model, level.of_base, targets, {}, progress);
  CHECK(last.finished);
  CHECK(last.iteration < 40);  // the damping exceeds its upper bound
  CHECK(same.stiffness == level.model.stiffness);
  for (const double mass : same.mass) CHECK(std::isfinite(mass));
}

template <class Member>
void change(Member& member) {
  if constexpr (std::is_enum_v<Member>)
    member = static_cast<Member>(static_cast<int>(member) + 1);
  else if constexpr (std::is_arithmetic_v<Member>)
    member += 1;
  else
    member.emplace();
}
template <class Element>
void change(std::vector<Element>& list) {
  list.emplace_back();
}
void change(Support& support) {
  support.springs.push_back({0, 1});
}

TEST_CASE("A change of any option of the targets, but a weight, is another fingerprint") {
  const MassSpringModel base = block(4, 4, 6);
  const Groups groups = identity_groups(base.node_count());
  const std::string usual = fingerprint_of(base, TargetOptions{}, {groups});
  std::size_t rows = 0;
  const TargetOptions all;
  for_each_option(all, [&](const auto&, const auto&) { ++rows; });
  REQUIRE(rows > 5);
  for (std::size_t changed = 0; changed < rows; ++changed) {
    TargetOptions options;
    bool measured = true;
    std::size_t number = 0;
    for_each_option(options, [&](const auto& row, auto& member) {
      if (number++ != changed) return;
      if constexpr (requires { row.is_weight; }) measured = !row.is_weight;
      change(member);
    });
    CAPTURE(changed);
    CHECK((fingerprint_of(base, options, {groups}) != usual) == measured);
  }
  Groups others = groups;
  others.of[1] = others.of[0];
  CHECK(fingerprint_of(base, TargetOptions{}, {others}) != usual);
  CHECK(fingerprint_of(base, TargetOptions{}, {groups, groups}) != usual);
}
