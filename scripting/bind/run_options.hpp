#pragma once

#include <memory>
#include <vector>

#include "scripting/bind/values.hpp"
#include "scripting/engine/api.hpp"
#include "scripting/engine/call.hpp"
#include "sim/run.hpp"

namespace springlod::scripting {

/// The options of every function that runs models; `usual` is what it does without them.
std::vector<Parameter> run_parameters(const sim::RunOptions& usual);
/// All but `contact`, which takes a level to make sense of.
void read_run_options(Call& call, TableReader& reader, sim::RunOptions& options);

sim::ContactAt read_contact(TableReader& reader);
/// For RunOptions: where the model touches obstacles. A model of its own is its own base.
std::shared_ptr<const sim::ContactSkin> skin_of(const ModelValue& model, sim::ContactAt contact);

}  // namespace springlod::scripting
