#include "lod/quality/certify.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "elastic/loads.hpp"
#include "elastic/modes.hpp"
#include "elastic/moduli.hpp"
#include "elastic/stable_step.hpp"
#include "elastic/zero_modes.hpp"
#include "lod/calibration/elastic_targets.hpp"
#include "lod/calibration/second_moments.hpp"
#include "lod/calibration/tolerance.hpp"
#include "lod/group_means.hpp"
#include "lod/quality/compared_loads.hpp"
#include "lod/quality/motion_errors.hpp"

namespace springlod::lod {
namespace {

/// Base frequencies within this fraction of each other count as one multiple eigenvalue, such as a
/// sphere has. The mode shapes of a multiple eigenvalue are not unique.
constexpr double kSameFrequency = 0.05;

/// Values measured of the base and of each level.
struct Measured {
  std::vector<elastic::Mode> modes;
  std::vector<double> decay;  // of the modes [1/s]
  std::vector<elastic::StaticSolution> solutions;
  std::vector<elastic::MaterialModuli> moduli;
  double highest_frequency = 0, stable_step = 0, cost = 0;
};

Measured measure(const MassSpringModel& model, const std::vector<elastic::StaticLoad>& loads,
                 std::size_t smooth, const Support& anchored, std::uint32_t modes) {
  const elastic::ElasticBody body = elastic::elastic_body(model, {.anchored = anchored});
  Measured measured;
  measured.modes = elastic::lowest_modes(body, {.count = modes}).modes;
  for (const elastic::Mode& mode : measured.modes)
    measured.decay.push_back(decay_rate(model, mode));
  measured.solutions = elastic::solve_static(body, loads, {.balance_free_motions = true});
  measured.moduli = elastic::measured_moduli(
      model, {measured.solutions.begin(),
              measured.solutions.begin() + static_cast<std::ptrdiff_t>(smooth)});
  measured.highest_frequency = elastic::largest_frequency(model);
  measured.stable_step =
      elastic::stable_step(measured.highest_frequency, elastic::largest_damping_time(model));
  measured.cost = model.spring_count() / measured.stable_step;
  return measured;
}

void compare_modes(const Measured& base, const Measured& found,
                   const std::vector<std::vector<Vec3>>& shapes, const std::vector<double>& mass,
                   Certificate& certificate) {
  for (std::size_t i = 0; i < std::min(base.modes.size(), found.modes.size()); ++i) {
    Certificate::Frequency& frequency = certificate.frequencies.emplace_back();
    frequency.level = found.modes[i].frequency();
    frequency.base = base.modes[i].frequency();
    frequency.decay = found.decay[i];
    frequency.base_decay = base.decay[i];
    for (std::size_t j = 0; j < base.modes.size(); ++j) {
      const double ratio = base.modes[j].angular_frequency / base.modes[i].angular_frequency;
      if (std::abs(ratio - 1) > kSameFrequency) continue;
      const double along = mass_product(mass, shapes[j], found.modes[i].shape);
      frequency.mac += along * along / mass_product(mass, shapes[j], shapes[j]);
    }
    frequency.mac = std::min(1.0, frequency.mac);
  }
}

void compare_motion(const LodChain& chain, const Level& level, const Measured& base,
                    const Measured& found, Certificate& certificate) {
  const MassSpringModel& base_model = chain.levels.front().model;
  std::vector<std::vector<Vec3>> shapes;
  for (const elastic::Mode& mode : base.modes)
    shapes.push_back(group_means(mode.shape, base_model.mass, level.of_base));
  compare_modes(base, found, shapes, level.model.mass, certificate);
  const ModalMotion motion{base_model, level, base.modes, found.modes, shapes};
  certificate.blow_error = blow_error(motion);
  certificate.first_period_error = first_period_error(motion);
}

/// Compares compliances of a level with the work of the loads on the means of the base over its
/// groups, as a fit does.
void compare_loads(const ComparedLoads& loads, const LodChain& chain, const Level& level,
                   const Measured& base, const Measured& found, Certificate& certificate) {
  for (std::size_t l = 0; l < loads.all.size(); ++l) {
    const double compliance = work_on_means(loads.all[l].force, base.solutions[l].displacement,
                                            chain.levels.front().model.mass, level.of_base);
    if (!(compliance > 0)) continue;  // the load has no effect on the groups
    certificate.loads.push_back({loads.all[l].name, loads.held_out(l), compliance,
                                 found.solutions[l].compliance / compliance - 1});
  }
}

void compare_moduli(const MassSpringModel& model, const Measured& base, const Measured& found,
                    Certificate& certificate) {
  for (const elastic::MaterialModuli& of_base : base.moduli)
    for (const elastic::MaterialModuli& of_level : found.moduli)
      if (of_level.material == of_base.material)
        certificate.moduli.push_back({model.materials[of_base.material].name, of_level.young,
                                      of_base.young, of_level.poisson, of_base.poisson});
}

void compare_masses(const MassSpringModel& base, const MassSpringModel& level,
                    Certificate& certificate) {
  const MassProperties wanted = mass_properties(base);
  const MassProperties found = mass_properties(level);
  const Mat3 moments = second_moments(base);
  certificate.mass_error = found.mass / wanted.mass - 1;
  const double radius = std::sqrt(moments.trace() / wanted.mass);
  certificate.center_shift = radius > 0 ? (found.center - wanted.center).norm() / radius : 0;
  const double largest = moments.cwiseAbs().maxCoeff();
  certificate.second_moment_error =
      largest > 0 ? (second_moments(level) - moments).cwiseAbs().maxCoeff() / largest : 0;
}

/// Largest contact area over mass of a node [m2/kg].
double largest_area_over_mass(const MassSpringModel& model) {
  double largest = 0;
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    largest = std::max(largest, model.contact_area[i] / model.mass[i]);
  return largest;
}

void compare_contact(const MassSpringModel& base, const MassSpringModel& level,
                     Certificate& certificate) {
  const double of_base = largest_area_over_mass(base);
  if (of_base > 0) certificate.contact_ratio = largest_area_over_mass(level) / of_base;
}

void check_tolerance(Certificate& c) {
  const double error = mean_frequency_error(c, 0, kLowestModes);
  constexpr double kPercent = 100;
  if (c.tolerance > 0 && error > c.tolerance)
    c.unmet.push_back(fmt::format("lowest ten frequencies: error {:.3g} %, tolerance {:.3g} %",
                                  kPercent * error, kPercent * c.tolerance));
}

}  // namespace

void certify(LodChain& chain, const CertifyOptions& options) {
  const MassSpringModel& base = chain.levels.front().model;
  const ComparedLoads loads = compared_loads(base, {.count = options.held_out_loads,
                                                    .seed = options.seed,
                                                    .radius = options.radius,
                                                    .within = options.within});
  Task task(options.progress, "certifying", chain.levels.size());
  const Measured of_base = measure(base, loads.all, loads.smooth, options.anchored, options.modes);
  task.advance();
  run_jobs(chain.levels.size() - 1, options.threads,
           [&](std::uint64_t job, const std::function<bool()>& stopped) {
             Level& level = chain.levels[job + 1];
             if (stopped()) throw InterruptedError();
             if (level.model.spring_count() == 0) return task.advance();  // no elasticity
             std::vector<elastic::StaticLoad> summed;
             for (const elastic::StaticLoad& load : loads.all)
               summed.push_back(summed_over_groups(level.of_base, load));
             const Measured found =
                 measure(level.model, summed, loads.smooth,
                         mapped_support(level.of_base, options.anchored), options.modes);
             Certificate c;
             compare_motion(chain, level, of_base, found, c);
             compare_loads(loads, chain, level, of_base, found, c);
             compare_moduli(base, of_base, found, c);
             compare_masses(base, level.model, c);
             compare_contact(base, level.model, c);
             c.highest_frequency = found.highest_frequency;
             c.base_highest_frequency = of_base.highest_frequency;
             c.stable_step = found.stable_step;
             c.base_stable_step = of_base.stable_step;
             c.cost = found.cost;
             c.base_cost = of_base.cost;
             for (const elastic::ComponentModes& part : elastic::zero_modes(level.model)) {
               c.zero_modes += part.zero_modes;
               c.expected_zero_modes += part.expected;
             }
             c.tolerance = options.tolerance;
             check_tolerance(c);
             level.certificate = std::move(c);
             task.advance();
           });
}

}  // namespace springlod::lod
