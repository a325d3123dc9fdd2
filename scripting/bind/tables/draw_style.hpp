#pragma once

#include <vector>

#include "render/scene.hpp"
#include "scripting/engine/call.hpp"

namespace springlod::scripting {

/// Reads the options of a DrawStyle (surface, nodes, springs, ...), listed by style_parameters().
/// If node values are shown, nodes are drawn and the surface that would hide them is not, unless
/// the script sets these options.
void read_style(const Call& call, TableReader& reader, render::DrawStyle& style);
std::vector<Parameter> style_parameters(const render::DrawStyle& usual);

/// Sets values on the nodes. Nodes are drawn and the surface is not, unless the script sets these
/// options.
void show_node_values(TableReader& reader, render::DrawStyle& style);

}  // namespace springlod::scripting
