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
std::string name(Size size);                 ///< "4k", "40k", "300k": about so many nodes
std::string name(sim::Precision precision);  ///< "f32", "f64"

/// A body to be stepped.
struct Subject {
  MassSpringModel model;
  double step = 0;  ///< [s] far from any limit: what is measured is work, not motion
};

/// Gravity, and a floor at z = 0 as the naive step has it.
sim::Scenario rest_on_floor();

/// The bodies that benchmarks step, each made when it is first asked for.
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
