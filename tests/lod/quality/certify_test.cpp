#include "lod/quality/certify.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "elastic/modes.hpp"
#include "lod/build.hpp"
#include "lod/group_means.hpp"
#include "lod/quality/grade.hpp"
#include "lod/quality/motion_errors.hpp"
#include "tests/support/bodies.hpp"

using namespace springlod;
using namespace springlod::lod;
using Catch::Contains;
using Catch::StartsWith;
using springlod::test::block;

namespace {

LodChain chain_of(MassSpringModel base, MassSpringModel level) {
  LodChain chain;
  const Groups same = identity_groups(base.node_count());
  chain.levels.push_back({std::move(base), same, "base"});
  chain.levels.push_back({std::move(level), same, "level"});
  return chain;
}

Certificate certificate_of(MassSpringModel base, MassSpringModel level) {
  LodChain chain = chain_of(std::move(base), std::move(level));
  certify(chain, {.modes = 12, .held_out_loads = 4});
  return *chain.levels[1].certificate;
}

MassSpringModel times(MassSpringModel model, double stiffness, double mass) {
  for (double& k : model.stiffness) k *= stiffness;
  for (double& m : model.mass) m *= mass;
  return model;
}

}  // namespace

TEST_CASE("A level that is its base has no error") {
  const Certificate c = certificate_of(block(3, 4, 5), block(3, 4, 5));
  CHECK(mean_frequency_error(c, 0, 10) < 1e-9);
  CHECK(mean_mac(c).value() > 0.9999);
  CHECK(c.blow_error.value() < 1e-9);
  CHECK(c.first_period_error.value() < 1e-3);
  CHECK(c.contact_ratio.value() == Approx(1));
  CHECK(mean_decay_error(c).value() < 1e-6);
  CHECK(grade(c) == Grade::good);
  CHECK(c.unmet.empty());
}

TEST_CASE("A level of k^2 times the stiffness vibrates k times as fast") {
  const double k = 1.05;
  const Certificate c = certificate_of(block(3, 4, 5), times(block(3, 4, 5), k * k, 1));
  CHECK(mean_frequency_error(c, 0, 10) == Approx(k - 1));
  CHECK(c.blow_error.value() < 1e-9);
  CHECK(grade(c) == Grade::rough);
  // sin(w t) / w against sin(k w t) / (k w), for each mode over one period of the first
  const MassSpringModel base = block(3, 4, 5);
  const std::vector<elastic::Mode> modes = elastic::lowest_modes(base, {.count = 10}).modes;
  double error = 0, size = 0;
  for (const elastic::Mode& mode : modes)
    for (int i = 1; i <= 24; ++i) {
      const double w = mode.angular_frequency;
      const double t = 2 * std::numbers::pi / modes[0].angular_frequency * i / 24;
      const double wanted = std::sin(w * t) / w;
      error += std::pow(std::sin(k * w * t) / (k * w) - wanted, 2);
      size += wanted * wanted;
    }
  CHECK(c.first_period_error.value() == Approx(std::sqrt(error / size)).epsilon(1e-3));
}

TEST_CASE("Masses that differ from those of the groups show after impacts") {
  MassSpringModel level = block(3, 3, 3);
  for (double& m : level.mass) m *= 1.25;
  const Certificate c = certificate_of(block(3, 3, 3), level);
  CHECK(c.blow_error.value() == Approx(0.2));
  CHECK(c.contact_ratio.value() == Approx(0.8));
  CHECK(grade(c) == Grade::faulty);
  CHECK_THAT(grade_text(c), StartsWith("faulty: its mass is 25 % off; ") &&
                                Contains("velocities after an impact 20 % off"));
}

TEST_CASE("Springs with damping time b make a mode of frequency w decay at b w^2 / 2") {
  MassSpringModel model = block(3, 3, 4);
  const double time = 1e-4;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    model.damping[s] = time * model.stiffness[s];
  for (const elastic::Mode& mode : elastic::lowest_modes(model, {.count = 5}).modes)
    CHECK(decay_rate(model, mode) ==
          Approx(time * mode.angular_frequency * mode.angular_frequency / 2).epsilon(1e-3));
}

TEST_CASE("Only a tolerance that was asked for is checked") {
  LodChain chain = simplify(block(4, 4, 6), {.levels = 1, .keep = {0.3}});
  certify(chain, {.modes = 12, .held_out_loads = 4});
  const double error = mean_frequency_error(*chain.levels[1].certificate, 0, 10);
  CHECK(chain.levels[1].certificate->unmet.empty());
  for (const double factor : {0.9, 1.1}) {
    certify(chain, {.modes = 12, .held_out_loads = 4, .tolerance = factor * error});
    CHECK(chain.levels[1].certificate->unmet.size() == (factor < 1 ? 1 : 0));
    CHECK(chain.levels[1].certificate->tolerance == factor * error);
  }
}

TEST_CASE("A grade is that of the worst quantity, and names materials that are off") {
  Certificate c;
  c.frequencies = {{100.5, 100, 1, 0, 0}};
  c.first_period_error = 0.1;
  c.moduli = {{"core", 0.9, 1, 0.25, 0.25}, {"shell", 2, 2, 0.25, 0.25}};
  CHECK(grade_text(c) ==
        "good: natural frequencies 0.50 % off, first period of vibration 10 % off");
  c.moduli[0].young = 0.6;
  CHECK(grade_text(c) ==
        "fair: core has 0.60 of its Young's modulus (good is 0.80 to 1.25); natural frequencies "
        "0.50 % off, first period of vibration 10 % off");
  c.frequencies[0].level = 102;
  CHECK_THAT(grade_text(c), StartsWith("fair: natural frequencies 2.0 % off (good is up to 1 %), "
                                       "core has 0.60 of its Young's modulus (good is"));
  c.first_period_error = 0.5;
  CHECK_THAT(grade_text(c),
             StartsWith("rough: first period of vibration 50 % off (fair is up to 40 %); natural "
                        "frequencies 2.0 % off, core has 0.60"));
  c.moduli[0].young = 0.3;
  CHECK(grade(c) == Grade::rough);
  c.zero_modes = 7;
  c.expected_zero_modes = 6;
  CHECK_THAT(grade_text(c), StartsWith("faulty: 7 zero modes instead of 6; natural frequencies"));
}
