#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scripting/bind/tables/values.hpp"
#include "scripting/engine/api.hpp"
#include "scripting/engine/call.hpp"
#include "scripting/engine/session.hpp"
#include "sim/run.hpp"

namespace springlod::scripting {

/// Describes the option `contact` of functions that run a level of a chain.
Parameter contact_parameter();
std::optional<ContactAt> read_contact(TableReader& reader);
/// For RunOptions: where the model touches obstacles; without `contact`, as its chain says. A model
/// without a chain is its own base.
std::shared_ptr<const sim::ContactSkin> skin_of(const ModelValue& model,
                                                std::optional<ContactAt> contact);

/// "to 12 % of that without damping (...); ...", and what to do: for a run whose step is limited by
/// damping.
std::string damping_hint(const sim::Trajectory& run);

/// Whether no run or comparison of this session has printed damping_hint() for a body with this
/// base; from then on one has. A script that runs a body often prints the hint once.
bool first_hint_at_damping(Session& session, const MassSpringModel& base);

/// For warnings: what keeps a body from turning inside out. `resisted`: its corners resisted.
std::string inversion_hint(bool resisted);

}  // namespace springlod::scripting
