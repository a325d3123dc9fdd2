#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scripting/engine/call.hpp"
#include "sim/integrators/integrator.hpp"

namespace springlod::scripting {

/// "symplectic_euler", ...
std::vector<std::string> integrator_words();

/// Option `name`, one of the words; left alone if it is not given.
void read_integrator(TableReader& reader, std::string_view name, sim::Integrator& into);
/// Option `name`, a list of the words.
void read_integrators(TableReader& reader, std::string_view name,
                      std::vector<sim::Integrator>& into);

}  // namespace springlod::scripting
