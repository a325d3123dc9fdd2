#include "lod/quality/merge_log.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "elastic/loads.hpp"
#include "elastic/modes.hpp"
#include "lod/calibration/elastic_targets.hpp"
#include "lod/group_means.hpp"
#include "lod/quality/compared_loads.hpp"
#include "lod/quality/compliance_change.hpp"
#include "lod/transfer.hpp"

namespace springlod::lod {
namespace {

/// Least compliance of a level, relative to the base. Clamped: the log-ratio diverges as the
/// compliance tends to zero, as where a load acts within one group.
constexpr double kLeastCompliance = 1e-3;

/// The modes and loads of a comparison.
struct Questions {
  std::vector<elastic::Mode> modes;
  std::vector<elastic::StaticLoad> loads;  // on the base's nodes
  std::vector<Answer> answers;             // of the modes, then of the loads
};

/// The responses of a level, mode by mode and load by load.
struct Answers {
  std::vector<std::vector<Vec3>> displacement;
  std::vector<double> compliance;
  /// Work of the inertia forces of each mode along the mode itself, node by node [J].
  std::vector<std::vector<double>> work;
};

/// The static loads that have an effect on the base; a stretch across a flat model has none.
Questions loads_of(const MassSpringModel& base, const elastic::ElasticBody& body,
                   const MergeLogOptions& options) {
  // The loads of certify.
  ComparedLoads loads = compared_loads(base, {.count = options.local_loads, .seed = options.seed});
  Questions kept;
  const std::vector<elastic::StaticSolution> solved =
      elastic::solve_static(body, loads.all, {.balance_free_motions = true});
  for (std::size_t l = 0; l < loads.all.size(); ++l) {
    if (!(solved[l].compliance > 0)) continue;
    kept.answers.push_back(
        {loads.all[l].name, loads.held_out(l) ? Answer::Kind::local : Answer::Kind::smooth});
    kept.loads.push_back(std::move(loads.all[l]));
  }
  return kept;
}

/// The loads and the lowest modes of the level, interpolated to the base.
Questions questions_of(const LodChain& chain, std::uint32_t level, const elastic::ElasticBody& body,
                       const Questions& loads, std::uint32_t modes) {
  Questions questions;
  if (modes > 0) questions.modes = elastic::lowest_modes(body, {.count = modes}).modes;
  const Binding from_level = base_from_level(chain, level);
  for (std::size_t i = 0; i < questions.modes.size(); ++i) {
    questions.modes[i].shape = interpolate(from_level, questions.modes[i].shape);
    questions.answers.push_back({fmt::format("f{}", i + 1), Answer::Kind::mode});
  }
  questions.loads = loads.loads;
  questions.answers.insert(questions.answers.end(), loads.answers.begin(), loads.answers.end());
  return questions;
}

Answers answer(const MassSpringModel& base, const Level& level, const elastic::ElasticBody& body,
               const Questions& questions) {
  const MassSpringModel& model = level.model;
  Answers answers;
  std::vector<elastic::StaticLoad> loads;
  for (const elastic::Mode& mode : questions.modes) {
    // The forces omega^2 M phi deform the body into the shape phi.
    elastic::StaticLoad inertia{"inertia", group_means(mode.shape, base.mass, level.of_base)};
    std::vector<double>& work = answers.work.emplace_back();
    const double squared = mode.angular_frequency * mode.angular_frequency;
    for (std::uint32_t i = 0; i < model.node_count(); ++i) {
      work.push_back(squared * model.mass[i] * inertia.force[i].squaredNorm());
      inertia.force[i] *= squared * model.mass[i];
    }
    loads.push_back(std::move(inertia));
  }
  for (const elastic::StaticLoad& load : questions.loads)
    loads.push_back(summed_over_groups(level.of_base, load));
  for (elastic::StaticSolution& solution :
       elastic::solve_static(body, loads, {.balance_free_motions = true})) {
    answers.compliance.push_back(solution.compliance);
    answers.displacement.push_back(std::move(solution.displacement));
  }
  return answers;
}

/// The map from a level to a coarser one; none if the coarser one was not merged from it.
std::optional<Groups> groups_between(const Groups& finer, const Groups& coarser) {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  Groups between{std::vector<std::uint32_t>(finer.count, kNone), coarser.count};
  for (std::size_t i = 0; i < finer.of.size(); ++i) {
    std::uint32_t& into = between.of[finer.of[i]];
    if (into != kNone && into != coarser.of[i]) return std::nullopt;
    into = coarser.of[i];
  }
  return between;
}

/// (ln to - ln from) / (to - from).
double log_difference_quotient(double from, double to) {
  const double relative = to / from - 1;
  constexpr double kSmall = 1e-9;  // below, the quotient is rounding noise
  return (std::abs(relative) < kSmall ? 1 : std::log1p(relative) / relative) / from;
}

double sum_of(const std::vector<double>& parts) {
  return std::accumulate(parts.begin(), parts.end(), 0.0);
}

/// Change of response l from one level to another, of ln f or ln C.
double change_between(const Answers& from, const Answers& to, std::size_t l) {
  const double softer = std::log(to.compliance[l] / from.compliance[l]);
  if (l >= from.work.size()) return softer;
  return (std::log(sum_of(to.work[l]) / sum_of(from.work[l])) - softer) / 2;
}

/// Contribution of a change to the mean |error| of the responses of a kind.
double contribution_to_mean(const std::vector<Answer>& answers, Answer::Kind kind,
                            const std::vector<double>& error, const std::vector<double>& change) {
  double sum = 0;
  int count = 0;
  for (std::size_t l = 0; l < answers.size(); ++l) {
    if (answers[l].kind != kind) continue;
    sum += error[l] < 0 ? -change[l] : change[l];
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

class Log {
 public:
  Log(const LodChain& chain, const MergeLogOptions& options) : chain_(chain), options_(options) {}

  MergeLog make() {
    const std::vector<Level>& levels = chain_.levels;
    Task task(options_.progress, "logging merges", 2 * levels.size() - 1);
    const auto jobs = [&](std::size_t count, const auto& body) {
      run_jobs(count, options_.threads,
               [&](std::uint64_t job, const std::function<bool()>& stopped) {
                 if (stopped()) throw InterruptedError();
                 body(static_cast<std::uint32_t>(job));
                 task.advance();
               });
    };
    bodies_.resize(levels.size());
    jobs(levels.size(), [&](std::uint32_t n) {
      bodies_[n] = elastic::elastic_body(
          levels[n].model, {.anchored = mapped_support(levels[n].of_base, options_.anchored)});
    });
    loads_ = loads_of(levels.front().model, bodies_.front(), options_);
    MergeLog log;
    log.steps.resize(levels.size() - 1);
    jobs(levels.size() - 1, [&](std::uint32_t n) { log.steps[n] = step_to(n + 1); });
    return log;
  }

 private:
  MergeStep step_to(std::uint32_t level) const {
    const std::vector<Level>& levels = chain_.levels;
    MergeStep step;
    step.level = level;
    step.from = level - 1;
    std::optional<Groups> groups = groups_between(levels[step.from].of_base, levels[level].of_base);
    if (!groups || options_.from_base) {
      step.from = 0;
      groups = levels[level].of_base;
    }
    const Questions questions = questions_of(chain_, level, bodies_[level], loads_, options_.modes);
    const auto answers_of = [&](std::uint32_t n) {
      return answer(levels.front().model, levels[n], bodies_[n], questions);
    };
    const Answers of_base = answers_of(0);
    Answers to = answers_of(level);
    Answers from = step.from == 0 ? of_base : answers_of(step.from);
    for (Answers* answers : {&to, &from})
      for (std::size_t l = 0; l < of_base.compliance.size(); ++l)
        answers->compliance[l] =
            std::max(answers->compliance[l], kLeastCompliance * of_base.compliance[l]);
    step.answers = questions.answers;
    for (std::size_t l = 0; l < step.answers.size(); ++l) {
      step.change.push_back(change_between(from, to, l));
      step.error.push_back(change_between(of_base, to, l));
    }
    step.merges.resize(groups->count);
    for (std::uint32_t g = 0; g < groups->count; ++g) step.merges[g].node = g;
    for (const std::uint32_t g : groups->of) ++step.merges[g].pieces;
    attribute_changes(*groups, from, to, step);
    return step;
  }

  /// Splits the changes of the step into contributions of its merges.
  void attribute_changes(const Groups& groups, const Answers& from, const Answers& to,
                         MergeStep& step) const {
    const auto changes = compliance_changes(
        {chain_.levels[step.from].model, chain_.levels[step.level].model, groups},
        from.displacement, to.displacement);
    for (std::size_t l = 0; l < changes.size(); ++l) {
      const double softer = log_difference_quotient(from.compliance[l], to.compliance[l]);
      if (l >= from.work.size()) {
        for (Merge& merge : step.merges) merge.change.push_back(softer * changes[l][merge.node]);
        continue;
      }
      const double work = log_difference_quotient(sum_of(from.work[l]), sum_of(to.work[l]));
      std::vector<double> lost = to.work[l];
      for (std::size_t i = 0; i < groups.of.size(); ++i) lost[groups.of[i]] -= from.work[l][i];
      for (Merge& merge : step.merges)
        merge.change.push_back((work * lost[merge.node] - softer * changes[l][merge.node]) / 2);
    }
    for (Merge& merge : step.merges) {
      const auto contribution = [&](Answer::Kind kind) {
        return contribution_to_mean(step.answers, kind, step.error, merge.change);
      };
      merge.frequencies = contribution(Answer::Kind::mode);
      merge.smooth_loads = contribution(Answer::Kind::smooth);
      merge.local_loads = contribution(Answer::Kind::local);
    }
  }

  const LodChain& chain_;
  const MergeLogOptions& options_;
  std::vector<elastic::ElasticBody> bodies_;  // by level
  Questions loads_;
};

}  // namespace

MergeLog log_merges(const LodChain& chain, const MergeLogOptions& options) {
  if (chain.levels.size() < 2)
    throw InputError(
        "merge log: the chain has no level above the base, so nothing was merged; simplify it "
        "first");
  for (const Level& level : chain.levels)
    if (level.model.spring_count() == 0)
      throw InputError(fmt::format(
          "merge log: level {} has no springs, so no load deforms it; remove this level",
          &level - chain.levels.data()));
  return Log(chain, options).make();
}

double mean_error(const MergeStep& step, Answer::Kind kind) {
  return contribution_to_mean(step.answers, kind, step.error, step.error);
}

}  // namespace springlod::lod
