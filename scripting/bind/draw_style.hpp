#pragma once

#include <vector>

#include "render/scene.hpp"
#include "scripting/engine/call.hpp"

namespace springlod::scripting {

/// Reads the options of a DrawStyle (surface, nodes, springs, ...), listed by style_parameters().
/// To show numbers on the nodes is to show the nodes: unless the script says otherwise, it draws
/// them and leaves out the surface that would hide them.
void read_style(TableReader& reader, render::DrawStyle& style);
std::vector<Parameter> style_parameters(const render::DrawStyle& usual);

/// Numbers on the nodes, unless the script says otherwise: nodes are drawn, the surface is not.
void show_node_values(TableReader& reader, render::DrawStyle& style);

}  // namespace springlod::scripting
