#include "bench/subjects.hpp"

#include <algorithm>
#include <numeric>

#include "bench/bodies.hpp"
#include "bench/naive_step.hpp"
#include "elastic/stable_step.hpp"

namespace springlod::bench {
namespace {

constexpr double kSafety = 0.1;  // fraction of the stable step

// 16^3, 34^3 and 67^3 nodes: 4,096, 39,304 and 300,763.
MassSpringModel lattice(Size size) {
  return lattice_cube(size == Size::small ? 15 : size == Size::medium ? 33 : 66);
}
MassSpringModel merged(Size size) {
  return merged_cube(size == Size::small ? 4000 : size == Size::medium ? 40'000 : 300'000);
}

/// Lowers the body until the floor supports its weight, so that it stays in contact.
void lay_on_floor(MassSpringModel& model) {
  const Floor floor;
  const double weight = floor.gravity * std::accumulate(model.mass.begin(), model.mass.end(), 0.0);
  const double height = bounds(model.rest).sizes().z();
  const double z = -bounds(model.rest).min().z();  // height at which it just touches
  const auto pressed = [&](double depth) {
    double push = 0;
    for (std::uint32_t i = 0; i < model.node_count(); ++i)
      push +=
          floor.stiffness * model.contact_area[i] * std::max(0.0, depth - z - model.rest[i].z());
    return push;
  };
  constexpr int kHalvings = 40;
  double depth = 0;
  double part = height;
  for (int i = 0; i < kHalvings; ++i) {
    part /= 2;
    if (pressed(depth + part) < weight) depth += part;
  }
  for (Vec3& x : model.rest) x.z() += z - depth;
}

template <class Real>
Traffic traffic_of(const MassSpringModel& model, Shape shape) {
  const double springs = model.spring_count();
  return shape == Shape::lattice ? step_traffic(sim::make_row_layout<Real>(model), springs)
                                 : step_traffic(sim::make_quad_layout<Real>(model), springs);
}

}  // namespace

std::string name(Shape shape) {
  return shape == Shape::lattice ? "lattice" : "merged";
}
std::string name(Size size) {
  return size == Size::small ? "4k" : size == Size::medium ? "40k" : "300k";
}
std::string name(sim::Precision precision) {
  return precision == sim::Precision::single_precision ? "f32" : "f64";
}

sim::Scenario rest_on_floor() {
  const Floor floor;
  sim::Scenario scenario;
  scenario.gravity = {0, 0, -floor.gravity};
  scenario.obstacles = {{.shape = sim::Plane{},
                         .name = "floor",
                         .stiffness = floor.stiffness,
                         .friction = floor.friction}};
  return scenario;
}

const Subject& Subjects::subject(Shape shape, Size size) {
  const auto [found, is_new] = subjects_.try_emplace({shape, size});
  Subject& subject = found->second;
  if (is_new) {
    subject.model = shape == Shape::lattice ? lattice(size) : merged(size);
    lay_on_floor(subject.model);
    subject.step = kSafety * elastic::stable_step(elastic::frequency_bound(subject.model),
                                                  elastic::largest_damping_time(subject.model));
  }
  return subject;
}

std::shared_ptr<const sim::FastModel> Subjects::layout(Shape shape, Size size,
                                                       sim::Precision precision) {
  auto& layout = layouts_[{shape, size, precision}];
  if (!layout) layout = sim::make_fast_model(subject(shape, size).model, precision);
  return layout;
}

Traffic Subjects::traffic(Shape shape, Size size, sim::Precision precision) {
  const auto [found, is_new] = traffic_.try_emplace({shape, size, precision});
  if (is_new) {
    const MassSpringModel& model = subject(shape, size).model;
    found->second = precision == sim::Precision::single_precision
                        ? traffic_of<float>(model, shape)
                        : traffic_of<double>(model, shape);
  }
  return found->second;
}

}  // namespace springlod::bench
