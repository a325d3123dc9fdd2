#pragma once

#include <memory>
#include <vector>

#include "scripting/bind/values.hpp"
#include "scripting/engine/api.hpp"
#include "scripting/engine/call.hpp"
#include "sim/run.hpp"

namespace springlod::scripting {

/// The option `contact` of what runs a level, which takes its chain to make sense of.
Parameter contact_parameter();
sim::ContactAt read_contact(TableReader& reader);
/// For RunOptions: where the model touches obstacles. A model of its own is its own base.
std::shared_ptr<const sim::ContactSkin> skin_of(const ModelValue& model, sim::ContactAt contact);

}  // namespace springlod::scripting
