#include "lod/quality/merge_log.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "elastic/elastic_body.hpp"
#include "elastic/loads.hpp"
#include "elastic/modes.hpp"
#include "elastic/stiffness.hpp"
#include "lod/build.hpp"
#include "lod/grouping/grouping.hpp"
#include "lod/quality/certify.hpp"
#include "lod/quality/compared_loads.hpp"
#include "lod/quality/compliance_change.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/models.hpp"

using namespace springlod;
using namespace springlod::lod;
using Catch::Contains;
using springlod::test::ball;
using springlod::test::block;
using springlod::test::rods;

namespace {

/// A chain of the base and one level with each set of nodes merged.
LodChain merged_by_hand(const MassSpringModel& base,
                        const std::vector<std::vector<std::uint32_t>>& sets) {
  SimplifyOptions options{.levels = 1, .guards = false};
  options.groups = [&](const MassSpringModel& fine, const Groups&, std::uint32_t) {
    return groups_from_sets(fine, sets);
  };
  return simplify(base, options);
}

double correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  const double mx = std::accumulate(x.begin(), x.end(), 0.0) / n;
  const double my = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    yy += (y[i] - my) * (y[i] - my);
    xy += (x[i] - mx) * (y[i] - my);
  }
  return xy / std::sqrt(xx * yy);
}

std::vector<std::vector<std::uint32_t>> members(const Groups& groups) {
  std::vector<std::vector<std::uint32_t>> sets(groups.count);
  for (std::uint32_t i = 0; i < groups.of.size(); ++i) sets[groups.of[i]].push_back(i);
  return sets;
}

}  // namespace

TEST_CASE("contributions to a change of compliance add up and are 0 where nothing merged") {
  const MassSpringModel base = rods();
  const LodChain chain = simplify(base, {.levels = 2});
  const Level &coarse = chain.levels[1], &coarser = chain.levels[2];
  // For any displacements.
  std::mt19937_64 random(1);
  const auto any = [&](const MassSpringModel& model) {
    std::vector<Vec3> u;
    for (std::uint32_t i = 0; i < model.node_count(); ++i)
      u.emplace_back(test::uniform(random), test::uniform(random), test::uniform(random));
    return u;
  };
  const auto energy = [](const MassSpringModel& model, const std::vector<Vec3>& u) {
    std::vector<Vec3> force;
    elastic::apply_stiffness(model, u, force);
    double sum = 0;
    for (std::size_t i = 0; i < u.size(); ++i) sum += u[i].dot(force[i]);
    return sum;
  };
  for (const Level* level : {&coarse, &coarser}) {
    const std::vector<Vec3> u = any(base), v = any(level->model);
    const std::vector<double> part =
        compliance_changes({base, level->model, level->of_base}, {u}, {v})[0];
    const double change = energy(level->model, v) - energy(base, u);
    CHECK(std::accumulate(part.begin(), part.end(), 0.0) == Approx(change).epsilon(1e-9));
  }

  const Groups none = identity_groups(base.node_count());
  const std::vector<Vec3> u = any(base);
  const auto parts = compliance_changes({base, base, none}, {u}, {u});
  for (const double part : parts[0]) CHECK(part == Approx(0).margin(1e-9 * energy(base, u)));
  CHECK_THROWS_AS(compliance_changes({base, base, none}, {u}, {}), InputError);
  CHECK_THROWS_AS(compliance_changes({base, base, none}, {u}, {{}}), InputError);
}

TEST_CASE("a single merge gets nearly the whole change, and frequency changes are as measured") {
  const MassSpringModel base = block(3, 4, 9);
  const std::vector<elastic::Mode> before = elastic::lowest_modes(base, {.count = 3}).modes;
  for (const std::uint32_t spring : {100U, 300U, 500U}) {
    const LodChain chain = merged_by_hand(base, {{base.a[spring], base.b[spring]}});
    const MergeStep step = log_merges(chain, {.modes = 3, .local_loads = 3}).steps.at(0);
    CHECK(step.merges.size() == base.node_count() - 1);
    const auto merged = std::find_if(step.merges.begin(), step.merges.end(),
                                     [](const Merge& merge) { return merge.pieces == 2; });
    REQUIRE(merged != step.merges.end());
    CHECK(merged->node == chain.levels[1].of_base.of[base.a[spring]]);
    const std::vector<elastic::Mode> after =
        elastic::lowest_modes(chain.levels[1].model, {.count = 3}).modes;
    for (std::size_t l = 0; l < step.answers.size(); ++l) {
      CAPTURE(spring, step.answers[l].name, step.change[l]);
      CHECK(step.change[l] == step.error[l]);
      // Other nodes get a small contribution: the inertia that balances the load changes
      // everywhere.
      CHECK(merged->change[l] ==
            Approx(step.change[l]).margin(1e-4 + 0.03 * std::abs(step.change[l])));
      if (step.answers[l].kind != Answer::Kind::mode) continue;
      const double measured = std::log(after[l].frequency() / before[l].frequency());
      CHECK(step.change[l] == Approx(measured).margin(2e-4 + 0.1 * std::abs(measured)));
    }
  }
}

TEST_CASE("merges add up to their step, steps to the error, and errors agree with certify") {
  for (const MassSpringModel& base : {ball(), rods()}) {
    LodChain chain = simplify(base, {.levels = 2});
    const MergeLog log = log_merges(chain);
    REQUIRE(log.steps.size() == 2);
    CHECK(log.steps[1].from == 1);
    for (const MergeStep& step : log.steps) {
      double frequencies = 0;
      for (std::size_t l = 0; l < step.answers.size(); ++l) {
        double sum = 0;
        for (const Merge& merge : step.merges) sum += merge.change[l];
        CHECK(sum == Approx(step.change[l]).epsilon(1e-6).margin(1e-9));
      }
      for (const Merge& merge : step.merges) frequencies += merge.frequencies;
      if (step.from == 0)
        CHECK(frequencies == Approx(mean_error(step, Answer::Kind::mode)).epsilon(1e-6));
    }
    // Every level has the same loads.
    for (std::size_t l = 0; l < log.steps[0].answers.size(); ++l)
      if (log.steps[0].answers[l].kind == Answer::Kind::smooth)
        CHECK(log.steps[0].change[l] + log.steps[1].change[l] ==
              Approx(log.steps[1].error[l]).epsilon(1e-9));
    certify(chain, {.held_out_loads = 20});
    // The log tells the error of the whole compliance of the nodes, the certificate that of the
    // means of the groups.
    const ComparedLoads loads = compared_loads(base, {.count = 20});
    const std::vector<elastic::StaticSolution> whole =
        elastic::solve_static(elastic::elastic_body(base), loads.all);
    for (const MergeStep& step : log.steps) {
      const Certificate& c = *chain.levels[step.level].certificate;
      std::size_t modes = 0;
      while (step.answers[modes].kind == Answer::Kind::mode) ++modes;
      for (std::size_t l = 0; l < c.loads.size(); ++l) {
        const Certificate::Load& load = c.loads[l];
        CHECK(step.answers.at(modes + l).name == load.name);
        REQUIRE(loads.all[l].name == load.name);
        const double of_groups = std::log(load.compliance / whole[l].compliance);
        CHECK(step.error.at(modes + l) ==
              Approx(std::log1p(load.error) + of_groups).epsilon(1e-4).margin(1e-5));
      }
    }
  }
}

TEST_CASE("the costs of merges in a step correlate with their costs alone") {
  const MassSpringModel base = rods();
  const LodChain chain = simplify(base, {.levels = 1});
  const MergeLogOptions loads_only{.modes = 0, .local_loads = 0};
  const MergeStep step = log_merges(chain, loads_only).steps.at(0);
  const auto sets = members(chain.levels[1].of_base);
  std::vector<double> told, done;
  for (std::uint32_t g = 0; g < sets.size(); g += 5) {
    if (sets[g].size() < 2) continue;
    auto others = sets;
    others.erase(others.begin() + g);
    others.erase(std::remove_if(others.begin(), others.end(),
                                [](const auto& set) { return set.size() < 2; }),
                 others.end());
    const MergeStep first = log_merges(merged_by_hand(base, {sets[g]}), loads_only).steps.at(0);
    const MergeStep without = log_merges(merged_by_hand(base, others), loads_only).steps.at(0);
    for (std::size_t l = 0; l < step.answers.size(); ++l) {
      told.push_back(step.merges[g].change[l]);
      done.push_back((first.change[l] + step.change[l] - without.change[l]) / 2);
    }
  }
  CAPTURE(correlation(told, done), told.size());
  CHECK(correlation(told, done) > 0.7);
}

TEST_CASE("a merge that leaves a node loose is found by a motion that the base does not have") {
  // A bar in which a corner node is held by only three springs after its neighbours are merged.
  const MassSpringModel base = block(3, 3, 6);
  const std::uint32_t far = base.node_count() - 1;
  const LodChain sound = merged_by_hand(base, {{0, 1}});
  MassSpringModel weak = sound.levels[1].model;
  for (std::uint32_t s = 0; s < weak.spring_count(); ++s)
    if (weak.a[s] == far - 1 || weak.b[s] == far - 1) weak.stiffness[s] *= 0.01;
  LodChain chain = sound;
  chain.levels[1].model = weak;
  const MergeStep step = log_merges(chain, {.modes = 4}).steps.at(0);
  const auto worst = std::max_element(
      step.merges.begin(), step.merges.end(),
      [](const Merge& x, const Merge& y) { return x.frequencies < y.frequencies; });
  CHECK(mean_error(step, Answer::Kind::mode) > 0.1);
  CHECK(worst->node == far - 1);
}

TEST_CASE("the step to a level that was not merged from the one before starts from the base") {
  const LodChain chain =
      simplify(block(4, 4, 8),
               {.levels = 2, .keep = {0.5, 0.2}, .grouping = {.grouping = Grouping::compact}});
  const MergeLog log = log_merges(chain, {.modes = 3, .local_loads = 2});
  CHECK(log.steps[1].from == 0);
  CHECK(log.steps[1].change == log.steps[1].error);

  const LodChain nested = simplify(ball(), {.levels = 2});
  const MergeStep from_base =
      log_merges(nested, {.modes = 3, .local_loads = 2, .from_base = true}).steps[1];
  CHECK(from_base.from == 0);
  CHECK(from_base.change == from_base.error);
}

TEST_CASE("the error of a nearly rigid level is finite") {
  const MassSpringModel base = block(2, 2, 4);
  std::vector<std::vector<std::uint32_t>> halves(2);
  for (std::uint32_t i = 0; i < base.node_count(); ++i)
    halves[i < base.node_count() / 2 ? 0 : 1].push_back(i);
  const MergeStep step = log_merges(merged_by_hand(base, halves)).steps.at(0);
  CHECK(step.merges.size() == 2);
  for (const double error : step.error) CHECK(std::isfinite(error));
  for (const Merge& merge : step.merges)
    for (const double change : merge.change) CHECK(std::isfinite(change));
  CHECK(mean_error(step, Answer::Kind::smooth) > 1);
}

TEST_CASE("a log is bit-identical for any number of threads, a chain without merges is an error",
          "[threaded]") {
  const LodChain chain = simplify(ball(), {.levels = 2});
  const MergeLog one = log_merges(chain, {.local_loads = 4, .threads = 1});
  const MergeLog two = log_merges(chain, {.local_loads = 4, .threads = 2});
  for (std::size_t n = 0; n < 2; ++n)
    for (std::size_t g = 0; g < one.steps[n].merges.size(); ++g)
      CHECK(one.steps[n].merges[g].change == two.steps[n].merges[g].change);

  CHECK_THROWS_WITH(log_merges({{chain.levels[0]}}), Contains("nothing was merged"));
  LodChain point = chain;
  point.levels[2].model.a.clear();
  CHECK_THROWS_WITH(log_merges(point), Contains("level 2 has no springs"));
}
