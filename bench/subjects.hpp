#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>

#include "bench/traffic.hpp"
#include "model/mass_spring.hpp"
#include "sim/fast/fast_model.hpp"
#include "sim/scenario.hpp"

namespace springlod::bench {

enum class Shape { lattice, merged };
enum class Size { small, medium, large };

inline constexpr std::array kShapes{Shape::lattice, Shape::merged};
inline constexpr std::array kSizes{Size::small, Size::medium, Size::large};

std::string name(Shape shape);               ///< "lattice", "merged"
std::string name(Size size);                 ///< "4k", "40k", "300k": approximate number of nodes
std::string name(sim::Precision precision);  ///< "f32", "f64"

/// A body for step benchmarks.
struct Subject {
  MassSpringModel model;
  double step = 0;  ///< [s]; far below the stable step, as only the work is measured
};

/// Gravity and a floor at z = 0, equal to those of the naive step.
sim::Scenario rest_on_floor();

/// The bodies of step benchmarks, each created on first use.
class Subjects {
 public:
  const Subject& subject(Shape shape, Size size);
  std::shared_ptr<const sim::FastModel> layout(Shape shape, Size size, sim::Precision precision);
  Traffic traffic(Shape shape, Size size, sim::Precision precision);

 private:
  std::map<std::tuple<Shape, Size>, Subject> subjects_;
  std::map<std::tuple<Shape, Size, sim::Precision>, std::shared_ptr<const sim::FastModel>> layouts_;
  std::map<std::tuple<Shape, Size, sim::Precision>, Traffic> traffic_;
};

}  // namespace springlod::bench
