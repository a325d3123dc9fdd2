#include "sim/contact/node_surface.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/support/bodies.hpp"
#include "tests/support/models.hpp"

using namespace springlod;
using namespace springlod::sim;

namespace {

// Contact stiffness over that of the node with its neighbours held, at each node with an area.
std::vector<double> ratios(const MassSpringModel& model) {
  const NodeSurface surface = node_surface(model);
  std::vector<double> list;
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    if (model.contact_area[i] > 0) list.push_back(surface.contact[i] / surface.stiffness[i]);
  return list;
}

std::vector<double> ratios_of_block(double young) {
  return ratios(test::block(8, 8, 8, 0.0125, test::material("m", young, 1000, 0),
                            voxelize::LatticeStyle::corners));
}

}  // namespace

TEST_CASE(
    "The contact of a firm body yields four times as much as a node with its neighbours held") {
  for (const double ratio : ratios_of_block(1e7)) CHECK(ratio == Approx(0.25));
}

TEST_CASE("The contact of a soft body is as stiff as its weight needs") {
  const double cell = 0.0125, young = 1e5;
  const MassSpringModel model = test::block(8, 8, 8, cell, test::material("m", young, 1000, 0),
                                            voxelize::LatticeStyle::corners);
  const NodeSurface surface = node_surface(model);
  const double pressure = mass_properties(model).mass / mass_properties(model).volume * 9.81 *
                          std::sqrt(3.0) * 8 * cell;
  bool by_weight = false;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    if (!(model.contact_area[i] > 0)) {
      CHECK(surface.contact[i] == 0);
      continue;
    }
    const double ratio = surface.contact[i] / surface.stiffness[i];
    CHECK(ratio > 0.25);
    CHECK(ratio <= Approx(4));
    if (ratio > 3.9) continue;
    CHECK(surface.contact[i] ==
          Approx(pressure * model.contact_area[i] / (0.01 * mean_spring_length(model))));
    by_weight = true;
  }
  CHECK(by_weight);
}

TEST_CASE("The contact of a body that its weight squeezes is no stiffer than four times the body") {
  for (const double ratio : ratios_of_block(1e3)) CHECK(ratio == Approx(4));
}

TEST_CASE("A node without springs has a contact, and one without an area has none") {
  MassSpringModel model =
      test::table_model({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}, {1, 1, 1}, {{0, 1, 100}});
  model.contact_area = {0, 0.1, 0.2};
  const NodeSurface surface = node_surface(model);
  CHECK(surface.contact[0] == 0);
  CHECK(surface.contact[1] > 0);
  CHECK(surface.contact[2] == Approx(0.2 * 1e6));
}
