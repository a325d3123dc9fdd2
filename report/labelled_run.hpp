#pragma once

#include <string>

#include "model/binding.hpp"
#include "model/mass_spring.hpp"
#include "model/mesh.hpp"
#include "sim/run.hpp"
#include "sim/scenario.hpp"

namespace springlod::report {

/// A run of one model with its name in films and charts. What it refers to must outlive it.
struct LabelledRun {
  std::string label;
  const MassSpringModel& model;
  const sim::Trajectory& trajectory;
  const sim::Scenario& scenario;
  const TriangleMesh* surface = nullptr;  ///< that moves with the nodes; may be null
  Binding surface_of_nodes = {};          ///< its vertices from the nodes of `model`
};

}  // namespace springlod::report
