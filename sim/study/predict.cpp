#include "sim/study/predict.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "sim/study/deviation.hpp"
#include "sim/study/ensemble.hpp"
#include "sim/study/free_rotation.hpp"
#include "sim/study/level_cost.hpp"
#include "sim/study/run_progress.hpp"
#include "sim/study/twin.hpp"

namespace springlod::sim {
namespace {

// Relative change of all stiffnesses in the run that shows how much they matter [1]: about the
// error of a level, so that the response is still linear.
constexpr double kStiffnessChange = 0.02;

// Error of the stiffness that acts in a scene, over that of the held-out compliances of the
// certificate [1]. Above 1, because errors of compliances do not cancel in a scene as they do
// in a mean: measured 1 to 4 in free flight with spin.
constexpr double kStiffnessPerCompliance = 2;

// Error of the impulse of contacts over the impulse [1]. It is that of levels of any size: it
// depends on which node touches first, and in which phase of its vibration. Measured with
// contact points at the base's surface, 0.02 to 0.15, where it is the main error.
constexpr double kImpulseError = 0.05;
constexpr double kImpulseErrorAtSurface = 0.07;

// Factor on the whole error [1], for a choice on the safe side: the scatter of predictions is about
// 30 %, and a level that is too coarse is worse than one that is too fine.
constexpr double kSafety = 1.1;

// Tolerance by which a frame at the end of the window may seem to be later [s].
constexpr double kRounding = 1e-9;

// Smallest compliance of a level over the base's that counts [1]: its logarithm diverges at 0.
constexpr double kLeastCompliance = 1e-3;

/// Mean |ln(c / c0)| of the held-out compliances: the error of the stiffness that they show [1].
double stiffness_error(const Certificate& certificate) {
  double sum = 0;
  int count = 0;
  for (const Certificate::Load& load : certificate.loads) {
    if (!load.held_out) continue;
    sum += std::abs(std::log(std::max(kLeastCompliance, 1 + load.error)));
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

/// One run of the coarsest level.
struct ProbeRun {
  std::string name;
  const MassSpringModel* model = nullptr;
  const RunPlan* plan = nullptr;
  std::shared_ptr<const ContactSkin> skin = nullptr;
  bool obstacles = true;
  std::vector<Frame> frames{};
  std::uint64_t spring_updates = 0;
  double cost = 0;  // processor time for a simulated second [s/s]
};

/// One call of `predict_errors`.
class Predicting {
 public:
  Predicting(const LodChain& chain, const Scenario& scenario, const PredictOptions& options)
      : chain_(chain), scenario_(scenario), options_(options) {
    scenario_.stop.reset();
    while (probe_ > 0 && chain.levels[probe_].model.spring_count() == 0) --probe_;
  }

  Prediction predict() {
    const double infinity = std::numeric_limits<double>::infinity();
    result_.levels.resize(chain_.levels.size());
    for (std::size_t level = probe_ + 1; level < chain_.levels.size(); ++level)
      result_.levels[level].error = infinity;
    require_certificates();
    if (probe_ > 0) run_all();
    return std::move(result_);
  }

 private:
  static constexpr std::size_t kStiffer = 0, kFlight = 1, kFirstTwin = 2;  // in runs_

  void require_certificates() const {
    for (std::uint32_t level = 1; level <= probe_; ++level)
      if (!chain_.levels[level].certificate && chain_.levels[level].model.spring_count() > 0)
        throw InputError(fmt::format(
            "pick: level {} has no certificate, from which errors are predicted; certify(chain) "
            "measures it",
            level));
  }

  /// With contacts at the surface, there is one twin, the probe itself, for its cost.
  std::uint32_t first_twin() const { return at_nodes() ? 1 : probe_; }
  bool at_nodes() const { return options_.contact == ContactAt::nodes; }

  void run_all() {
    const MassSpringModel& body = chain_.levels[probe_].model;
    const MassSpringModel stiffer = stiffened(body, 1 + kStiffnessChange);
    const RunPlan plan = plan_runs(body, scenario_, options_.run);
    const RunPlan stiffer_plan = plan_runs(stiffer, scenario_, options_.run);
    const auto skin = std::make_shared<const ContactSkin>(contact_skin(chain_, probe_));
    center_ = center_of_mass(chain_.levels[0].model, chain_.levels[0].model.rest);
    runs_.push_back({"stiffer by 2 %", &stiffer, &stiffer_plan, skin});
    runs_.push_back({"without obstacles", &body, &plan, nullptr, false});
    if (!scenario_.obstacles.empty())
      for (std::uint32_t level = first_twin(); level <= probe_; ++level)
        runs_.push_back(
            {fmt::format("touching at the nodes of level {}", level), &body, &plan,
             std::make_shared<const ContactSkin>(nodes_of_level_as_skin(chain_, level, probe_))});
    Task task(options_.progress, "predict", (1 + runs_.size()) * RunProgress::kUnits);
    ProbeRun reference{"touching at the surface of the base", &body, &plan, skin};
    run_reference(reference);
    // Not 0 if the body touches at once and the window is empty.
    scenario_.duration =
        std::min(scenario_.duration, std::max(result_.end, 1 / options_.run.frame_rate));
    run_jobs(runs_.size(), options_.threads,
             [&](std::uint64_t job, const std::function<bool()>& stopped) {
               run_probe(runs_[job], stopped, std::nullopt);
             });
    reference_ = std::move(reference.frames);
    mass_ = body.mass;
    result_.probe = probe_;
    // The last twin touches at the probe's own nodes, as the probe does.
    result_.cost_at_nodes = runs_.back().cost;
    result_.cost_at_surface = reference.cost;
    result_.spring_updates = reference.spring_updates;
    for (const ProbeRun& one : runs_) result_.spring_updates += one.spring_updates;
    for (std::uint32_t level = 1; level <= probe_; ++level) combine(level);
  }

  void run_reference(ProbeRun& reference) {
    const auto never = [] { return false; };
    Trajectory trajectory = run_probe(reference, never, options_.error_window);
    result_.first_contact = trajectory.first_contact;
    trajectory.frames = reference.frames;
    result_.no_contact = no_contact(trajectory, scenario_);
    result_.end = scenario_.duration;
    if (trajectory.first_contact)
      result_.end = std::min(result_.end, *trajectory.first_contact + options_.error_window);
  }

  Trajectory run_probe(ProbeRun& probe, const std::function<bool()>& stopped,
                       std::optional<double> stop_after_contact) {
    RunProgress progress(options_.progress, stopped);
    RunOptions run_options = options_.run;
    run_options.skin = probe.skin;
    run_options.stop_after_contact = stop_after_contact;
    run_options.progress = &progress;
    Scenario scenario = scenario_;
    if (!probe.obstacles) {
      scenario.obstacles.clear();
      scenario.measure_from.clear();
    }
    RunSummary summary;
    Trajectory trajectory =
        run_start(*probe.model, scenario, center_, run_options, *probe.plan,
                  fmt::format("pick: level {} {}", probe_, probe.name), summary);
    progress.finish();
    probe.frames = std::move(trajectory.frames);
    probe.spring_updates = trajectory.spring_updates;
    probe.cost = cost_of(trajectory);
    return trajectory;
  }

  /// Mean distance of a run from the reference in the window [m].
  double distance(const ProbeRun& probe) const {
    double sum = 0;
    int count = 0;
    for (const Deviation& d : deviation_over_time(probe.frames, reference_, mass_)) {
      if (d.time > result_.end + kRounding) continue;
      sum += d.surface;
      ++count;
    }
    return sum / count;  // the first frame, t = 0, is always common
  }

  void combine(std::uint32_t level) {
    const Level& own = chain_.levels[level];
    PredictedError& e = result_.levels[level];
    if (own.model.spring_count() == 0) {
      e.error = std::numeric_limits<double>::infinity();
      return;
    }
    if (at_nodes() && runs_.size() > kFirstTwin)
      e.contact = distance(runs_[kFirstTwin + level - 1]);
    e.inertia = rotation_difference(chain_.levels[0].model, own.model, scenario_.start, result_.end,
                                    options_.run.frame_rate);
    e.elastic = kStiffnessPerCompliance * stiffness_error(*own.certificate) *
                distance(runs_[kStiffer]) / std::log1p(kStiffnessChange);
    e.impulse = (at_nodes() ? kImpulseError : kImpulseErrorAtSurface) * distance(runs_[kFlight]);
    e.error = kSafety * std::sqrt(e.contact * e.contact + e.inertia * e.inertia +
                                  e.elastic * e.elastic + e.impulse * e.impulse);
  }

  const LodChain& chain_;
  Scenario scenario_;
  const PredictOptions& options_;
  std::uint32_t probe_ = static_cast<std::uint32_t>(chain_.levels.size() - 1);
  Vec3 center_ = Vec3::Zero();
  std::vector<ProbeRun> runs_;
  std::vector<Frame> reference_;
  std::vector<double> mass_;  // of the nodes of the probing level [kg]
  Prediction result_;
};

}  // namespace

Prediction predict_errors(const LodChain& chain, const Scenario& scenario,
                          const PredictOptions& options) {
  return Predicting(chain, scenario, options).predict();
}

}  // namespace springlod::sim
