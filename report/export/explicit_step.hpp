#pragma once

#include <string>

#include "model/mass_spring.hpp"

namespace springlod::report {

/// Step for programs that integrate springs by explicit symplectic Euler with damping at the old
/// velocity [s]: 0.8 of the stable one at rest of the nodes and springs alone, without dilatation
/// terms. As in our own runs, the rest is for deformed states. Infinite without springs.
double explicit_step(const MassSpringModel& model);

/// That step as a line for settings, with what limits it.
std::string explicit_step_line(const MassSpringModel& model, double step);

}  // namespace springlod::report
